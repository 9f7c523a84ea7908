#pragma once

#include "jostle/lcp/lcp_problem.hpp"
#include "jostle/simulation/delassus_operator.hpp"
#include "jostle/simulation/scene.hpp"

namespace jostle {

/// Solves a contact problem by the method asked for; "auto" is projected SOR where the mobility does not couple rods,
/// else BBPGD.
///
/// Every method stops at the same residual, verified over all contacts, so results agree to the tolerance. Throws
/// InputError if projected SOR is asked for with a mobility that couples rods.
LcpResult solve_contact_problem(const ContactMatrix& contact_matrix, const Mobility& mobility,
                                const DelassusOperator& matrix, const LcpProblem& problem, SolverMethod method,
                                const LcpSettings& settings, std::span<const double> start = {});

}  // namespace jostle
