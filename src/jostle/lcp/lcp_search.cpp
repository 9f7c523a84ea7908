#include "jostle/lcp/lcp_search.hpp"

#include <cmath>
#include <utility>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

LcpSearch::LcpSearch(const LcpProblem& problem, const LcpSettings& settings, std::span<const double> start)
    : problem_(problem), settings_(settings) {
    for (auto& iterate : iterates_) {
        iterate.gamma.resize(problem.matrix.size());
        iterate.velocity.resize(problem.matrix.size());
    }
    if (!start.empty() && applications_left() > 0) {
        next().gamma.assign(start.begin(), start.end());
        next().gamma.resize(problem.matrix.size(), 0.0);
        apply_to_next();
    } else {
        next().velocity.assign(problem.constant.begin(), problem.constant.end());
    }
    iterates_[best_].residual = INFINITY;  // the empty one is not the best
    advance();
}

bool LcpSearch::unsolved() const {
    return std::isfinite(current().residual) && current().residual > settings_.tolerance && applications_left() > 0;
}

std::uint64_t LcpSearch::applications_left() const {
    return settings_.max_iterations > applications_ && !interrupted_ ? settings_.max_iterations - applications_ : 0;
}

void LcpSearch::apply(std::span<const double> x, std::span<double> image) {
    problem_.matrix.apply(x, image);
    ++applications_;
    interrupted_ = settings_.is_interrupted();
}

void LcpSearch::apply_to_next() {
    apply(next().gamma, next().velocity);
    parallel_for(next().velocity.size(), [&](std::size_t l) { next().velocity[l] += problem_.constant[l]; });
}

void LcpSearch::advance() {
    current_ = next_;
    LcpIterate& iterate = iterates_[current_];
    iterate.residual = lcp_residual(problem_, settings_.residual, iterate.gamma, iterate.velocity);
    ++since_best_;
    if (iterate.residual < iterates_[best_].residual) {
        best_ = current_;
        since_best_ = 0;
    }
    next_ = current_ == best_ ? (current_ + 1) % 3 : 3 - current_ - best_;
}

bool LcpSearch::next_halves_best() const {
    const LcpIterate& next = iterates_[next_];
    return lcp_residual(problem_, settings_.residual, next.gamma, next.velocity) < 0.5 * iterates_[best_].residual;
}

bool LcpSearch::circling() const {
    constexpr std::uint64_t patience = 20;
    return since_best_ >= patience && since_best_ % 2 == 0;
}

LcpResult LcpSearch::result() {
    const auto take = [](LcpIterate& iterate, LcpResult& result) {
        result.solution = std::move(iterate.gamma);
        result.velocity = std::move(iterate.velocity);
        result.residual = iterate.residual;
    };
    LcpResult result;
    result.iterations = applications_;
    take(iterates_[current_], result);
    result.status = lcp_status(problem_, settings_, result);
    if (interrupted_ && result.status != LcpStatus::converged) result.status = LcpStatus::interrupted;
    if (result.status != LcpStatus::converged && best_ != current_ && std::isfinite(iterates_[best_].residual))
        take(iterates_[best_], result);
    return result;
}

std::vector<double> inverse_diagonal(const LinearOperator& matrix) {
    const auto diagonal = matrix.diagonal();
    const double largest = parallel_max(diagonal.size(), 0.0, [&](std::size_t l) { return diagonal[l]; });
    std::vector<double> inverse(diagonal.size());
    parallel_for(diagonal.size(), [&](std::size_t l) {
        const double scale = diagonal[l] > 0.0 ? diagonal[l] : largest;
        inverse[l] = scale > 0.0 ? 1.0 / scale : 1.0;
    });
    return inverse;
}

double first_step_length(LcpSearch& search, std::span<const double> weight) {
    const std::vector<double>&gamma = search.current().gamma, &velocity = search.current().velocity;
    const auto weight_of = [&](std::size_t l) { return weight.empty() ? 1.0 : weight[l]; };
    std::vector<double> downhill(gamma.size()), image(gamma.size());
    parallel_for(gamma.size(), [&](std::size_t l) {
        const bool held = gamma[l] <= 0.0 && velocity[l] >= 0.0;
        downhill[l] = held ? 0.0 : weight_of(l) * velocity[l];
    });
    search.apply(downhill, image);
    const double curvature = parallel_sum<double>(gamma.size(), [&](std::size_t l) { return downhill[l] * image[l]; });
    if (curvature > 0.0) {
        const auto slope = [&](std::size_t l) { return downhill[l] * velocity[l]; };
        return parallel_sum<double>(gamma.size(), slope) / curvature;
    }
    // Downhill without end: any step will do, and the end of the search will tell the problem infeasible.
    const auto diagonal = search.problem().matrix.diagonal();
    const double largest = parallel_max(gamma.size(), 0.0, [&](std::size_t l) { return weight_of(l) * diagonal[l]; });
    return largest > 0.0 ? 1.0 / largest : 1.0;
}

}  // namespace jostle
