#pragma once

#include "jostle/lcp/lcp_problem.hpp"

namespace jostle {

/// Newton's method on the minimum map (Erleben 2013; Niebe and Erleben 2015), without a matrix:
///
///     H(gamma) = min(A_ll gamma_l, (A gamma + b)_l) = 0.
///
/// A contact is active where the velocity is the smaller of the two. A Newton step makes the velocities of all active
/// contacts vanish and takes the forces of the others away: a linear problem with the active part of A, solved by
/// conjugate gradients scaled by A_ll. The result is projected to gamma >= 0 and shortened until the energy
/// 1/2 gamma.A gamma + b.gamma falls; if it does not, a projected gradient step is taken instead. Every iteration thus
/// lowers the energy or halves the best residual, so it cannot run in circles.
///
/// Departures from the papers: the merit is the energy, as A is symmetric. While the active contacts still change, the
/// linear problem is solved to a fifth, in at most 10 iterations (measured: exact solutions of a wrong set cost several
/// times more, where it is over-determined, dozens); after that to the tolerance, in at most 100. Conjugate gradients
/// stop at a direction without curvature, as the active part of A may be singular.
///
/// LcpResult::iterations counts all applications of A, those in conjugate gradients and trial steps too. `start` is the
/// first iterate (>= 0), or empty for zero. settings.step_rule is not used. When it does not converge, the best iterate
/// is returned, with the reason. Deterministic for any number of threads.
LcpResult solve_minimum_map_newton(const LcpProblem& problem, const LcpSettings& settings,
                                   std::span<const double> start = {});

}  // namespace jostle
