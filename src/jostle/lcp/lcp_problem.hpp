#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "jostle/lcp/linear_operator.hpp"
#include "jostle/parallel/ranks.hpp"

namespace jostle {

/// Find gamma with  0 <= A gamma + b  perp  gamma >= 0  (theory, eq. 2.5), A symmetric positive semi-definite.
///
/// Equivalently: minimise 1/2 gamma.A.gamma + b.gamma over gamma >= 0. gamma need not be unique, A gamma is.
struct LcpProblem {
    const LinearOperator& matrix;
    std::span<const double> constant;  ///< b, a velocity per contact
    double time_step = 1.0;            ///< turns the velocities A gamma + b into lengths, for the residual
    Ranks ranks = {};                  ///< those that have the problem together: residual and status are of all of it
    std::span<const std::uint8_t> is_elsewhere = {};  ///< (contacts) whether another rank has it to add up; or none

    bool counts(std::size_t l) const { return is_elsewhere.empty() || is_elsewhere[l] == 0; }
};

/// Which numbers say that the problem is solved.
enum class LcpResidual {
    length,  ///< max_l |min(A_ll gamma_l, (A gamma + b)_l)| dt: a length, independent of units and of the number of
             ///< contacts
    paper,   ///< ||min(gamma, A gamma + b)||_2, which mixes a force and a velocity; only to repeat the paper
};

/// Step length of the Barzilai-Borwein iteration; s and y are the last changes of gamma and of the gradient.
enum class BarzilaiBorwein {
    bb1,          ///< s.s / s.y
    bb2,          ///< s.y / y.y
    alternating,  ///< bb1 at odd iterations, bb2 at even ones
};

struct LcpSettings {
    LcpResidual residual = LcpResidual::length;
    double tolerance = 1e-5;               ///< a length for LcpResidual::length; in the units of the problem
    std::uint64_t max_iterations = 10000;  ///< applications of A
    BarzilaiBorwein step_rule = BarzilaiBorwein::bb1;
    std::size_t colours_per_exchange = 1;  ///< of velocities between ranks; no bit depends on it
    /// Asked again and again while a solution is sought; once it says true the search ends. Empty: it never does.
    std::function<bool()> interrupted = {};

    bool is_interrupted() const { return interrupted && interrupted(); }
};

enum class LcpStatus {
    converged,
    iteration_limit,  ///< the residual is still above the tolerance
    infeasible,       ///< no velocity of the rods opens all contacts: they are packed too densely
    not_finite,       ///< the problem or an iterate holds NaN or infinity
    interrupted,      ///< LcpSettings::interrupted said so before the problem was solved
};

struct LcpResult {
    LcpStatus status = LcpStatus::converged;
    std::vector<double> solution;  ///< gamma >= 0: the last iterate, or the best one when not converged
    std::vector<double> velocity;  ///< A gamma + b of that iterate
    double residual = 0.0;         ///< of that iterate, in the chosen measure, over all contacts
    std::uint64_t iterations = 0;  ///< applications of A
};

/// The residual of a candidate solution, over all contacts. `velocity` is A gamma + b.
double lcp_residual(const LcpProblem& problem, LcpResidual kind, std::span<const double> gamma,
                    std::span<const double> velocity);

/// What a solver's last iterate amounts to: `result` with its solution, velocity and residual filled in.
///
/// A solution has gamma.A.gamma = -b.gamma. If no velocities of the rods open all contacts, the energy has no lower
/// bound, and gamma runs off along a direction with A gamma ~ 0 and b.gamma < 0 (Farkas' lemma), so the first becomes
/// small beside the second.
LcpStatus lcp_status(const LcpProblem& problem, const LcpSettings& settings, const LcpResult& result);

}  // namespace jostle
