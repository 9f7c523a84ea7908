#pragma once

#include <span>
#include <vector>

#include "jostle/contact_problem/contact_problem.hpp"
#include "jostle/rods/rod_mobility.hpp"
#include "jostle/simulation/known_motion.hpp"
#include "jostle/simulation/simulation_settings.hpp"
#include "jostle/state/state.hpp"

namespace jostle {

/// The contact forces that mirror the path of each rod where it meets another (theory, eq. 3.5), (contacts): those of
/// `solution`, which would leave the rods at touching, times `reflected_part`.
///
/// `axes`: of the moment that contacts have their normals of. `own`: (N) mobility of each rod alone. `strain`: of this
/// step, by a flow.
std::vector<double> reflected_forces(const ContactProblem& problem, const ContactSolution& solution, const State& state,
                                     const ArmAxes& axes, const KnownMotion& known, std::span<const RodMobility> own,
                                     const SimulationSettings& settings, double strain);

}  // namespace jostle
