#include "jostle/lcp/lcp_problem.hpp"

#include <algorithm>
#include <cmath>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

double lcp_residual(const LcpProblem& problem, LcpResidual kind, std::span<const double> gamma,
                    std::span<const double> velocity) {
    if (kind == LcpResidual::paper) {
        return std::sqrt(parallel_sum<double>(gamma.size(), [&](std::size_t l) {
            const double h = std::min(gamma[l], velocity[l]);
            return h * h;
        }));
    }
    const auto diagonal = problem.matrix.diagonal();
    return problem.time_step * parallel_max(gamma.size(), 0.0, [&](std::size_t l) {
               const double h = std::fabs(std::min(diagonal[l] * gamma[l], velocity[l]));
               return std::isnan(h) ? INFINITY : h;
           });
}

}  // namespace jostle
