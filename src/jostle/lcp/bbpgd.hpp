#pragma once

#include "jostle/lcp/lcp_problem.hpp"

namespace jostle {

/// Barzilai-Borwein projected gradient descent, the paper's solver (its appendix; Dai and Fletcher 2005):
///
///     gamma <- max(gamma - alpha (A gamma + b), 0),     one application of A an iteration.
///
/// Departures from the paper:
/// 1. The first step length is g.g / g.A g with g the projected gradient, where the paper takes all of g: contacts
///    that are apart at a cold start do not blur it then.
/// 2. The residual is a length by default (LcpResidual).
/// 3. s.y <= 0 (A is only semi-definite) keeps the last step length; s = 0 ends the iteration, which stands still.
/// 4. The iteration is not monotone, and BB1 alone can run in circles for ever where contacts are nearly dependent
///    (seen with two rods that touch at several points: a cycle of 11 iterations). After 20 iterations without a new
///    best residual every second step is a short one (BB2) until there is one.
/// 5. When it does not converge, the best iterate is returned, with the reason.
///
/// `start` is the first iterate (>= 0), or empty for zero. Deterministic for any number of threads.
LcpResult solve_bbpgd(const LcpProblem& problem, const LcpSettings& settings, std::span<const double> start = {});

}  // namespace jostle
