#include "jostle/lcp/lcp_problem.hpp"

#include <algorithm>
#include <cmath>

#include "jostle/parallel/sum_over_ranks.hpp"

namespace jostle {

namespace {

/// The smaller of two numbers; NaN if either is, which std::min would hide.
double minimum(double a, double b) {
    return std::isnan(a) || std::isnan(b) ? NAN : std::min(a, b);
}

}  // namespace

double lcp_residual(const LcpProblem& problem, LcpResidual kind, std::span<const double> gamma,
                    std::span<const double> velocity) {
    if (kind == LcpResidual::paper) {
        return std::sqrt(sum_over_ranks<double>(problem.ranks, gamma.size(), [&](std::size_t l) {
            const double h = minimum(gamma[l], velocity[l]);
            return problem.counts(l) ? h * h : 0.0;
        }));
    }
    const auto diagonal = problem.matrix.diagonal();
    const double largest = parallel_max(gamma.size(), 0.0, [&](std::size_t l) {
        const double h = std::fabs(minimum(diagonal[l] * gamma[l], velocity[l]));
        return std::isnan(h) ? INFINITY : h;
    });
    return problem.time_step * problem.ranks.largest(largest);
}

LcpStatus lcp_status(const LcpProblem& problem, const LcpSettings& settings, const LcpResult& result) {
    if (!std::isfinite(result.residual)) return LcpStatus::not_finite;
    if (result.residual <= settings.tolerance) return LcpStatus::converged;
    const auto along_gamma = [&](std::span<const double> values) {
        return sum_over_ranks<double>(problem.ranks, values.size(), [&](std::size_t l) {
            return problem.counts(l) ? values[l] * result.solution[l] : 0.0;
        });
    };
    const double along_constant = -along_gamma(problem.constant);
    const double energy = along_gamma(result.velocity) + along_constant;  // gamma.A.gamma
    if (!std::isfinite(along_constant) || !std::isfinite(energy)) return LcpStatus::not_finite;
    return energy < 0.5 * along_constant ? LcpStatus::infeasible : LcpStatus::iteration_limit;
}

}  // namespace jostle
