#pragma once

#include "jostle/contact_problem/contact_problem.hpp"

namespace jostle {

/// The contact forces as they are while the rods of each contact touch: gamma A_ll(as the step begins)/A_ll(touching),
/// and D gamma of these (theory, eq. 7.10). Velocities stay those of the solution.
///
/// Two rods that collide begin the step apart, where the fluid hinders their approach less than where they touch. Their
/// contact problem takes A_ll from there, and so too small a force.
ContactSolution forces_at_touching(const ContactProblem& problem, const ContactSolution& solution, const Rods& rods,
                                   const MobilityOperator& mobility);

}  // namespace jostle
