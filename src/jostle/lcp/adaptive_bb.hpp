#pragma once

#include "jostle/lcp/lcp_problem.hpp"

namespace jostle {

/// Projected gradient descent with adaptive Barzilai-Borwein steps (Zhou, Gao and Dai 2006; ABBmin of Frassoldati,
/// Zanni and Zanghirati 2008), one application of A an iteration:
///
///     gamma <- max(gamma - alpha (A gamma + b) / A_ll, 0).
///
/// With s and y the last changes of gamma and of the gradient, scaled by sqrt(A_ll), alpha is the long step s.s / s.y
/// unless the short one, s.y / y.y, is below a threshold fraction of it; then it is the shortest of the last short
/// steps. The threshold falls by a tenth when a short step was taken and grows by a tenth when a long one was, as in
/// Bonettini, Zanella and Zanni 2009.
///
/// Departures from these papers:
/// 1. y.y is taken over contacts with s != 0: those that stay without force tell nothing about the steps of the others.
/// 2. No line search, which costs more than it saves here. Against running in circles, LcpSearch::circling asks for
///    short steps.
/// 3. s.y <= 0 (A is only semi-definite) keeps the last step length; s = 0 means that the iteration stands still, and
///    ends it.
///
/// `start` is the first iterate (>= 0), or empty for zero. settings.step_rule is not used. When it does not converge,
/// the best iterate is returned, with the reason. Deterministic for any number of threads.
LcpResult solve_adaptive_bb(const LcpProblem& problem, const LcpSettings& settings, std::span<const double> start = {});

}  // namespace jostle
