#pragma once

#include "jostle/lcp/lcp_problem.hpp"

namespace jostle {

/// Accelerated projected gradient descent (Nesterov 1983; for contacts Mazhar, Heyn, Negrut and Tasora 2015):
///
///     gamma+ = max(eta - (A eta + b) / (L A_ll), 0),    eta+ = gamma+ + beta (gamma+ - gamma),
///
/// with the momentum beta of Nesterov's sequence. L bounds the curvature of the scaled problem along each step: a step
/// d = gamma+ - eta with d.A d > L d.diag(A) d is taken anew with a larger L, and L shrinks a little after each step.
/// The momentum is dropped (restart) when it points uphill.
///
/// Departures from the paper:
/// 1. Scaled by sqrt(A_ll).
/// 2. A eta follows from A gamma of the last two iterates, so an iteration costs one application of A, and one more for
///    each step taken anew.
/// 3. d.A d is taken from the changes themselves, not from a difference of energies, which is lost in rounding near the
///    solution. A rejected L grows to what the rejected step showed, or by half if that is more.
/// 4. The first L comes from the projected gradient. L does not fall below 1/10: some direction has at least 1.
///
/// `start` is the first iterate (>= 0), or empty for zero. settings.step_rule is not used. When it does not converge,
/// the best iterate is returned, with the reason. Deterministic for any number of threads.
LcpResult solve_apgd(const LcpProblem& problem, const LcpSettings& settings, std::span<const double> start = {});

}  // namespace jostle
