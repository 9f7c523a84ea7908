#include "jostle/lcp/bbpgd.hpp"

#include <algorithm>
#include <cmath>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

double sum_of_products(std::span<const double> a, std::span<const double> b) {
    return parallel_sum<double>(a.size(), [&](std::size_t l) { return a[l] * b[l]; });
}

/// s.s, s.y, y.y of the last step s of gamma and y of the gradient.
struct StepProducts {
    double ss = 0.0, sy = 0.0, yy = 0.0;
    StepProducts& operator+=(const StepProducts& other) {
        ss += other.ss;
        sy += other.sy;
        yy += other.yy;
        return *this;
    }
};

/// The iterate, with room for the next one.
struct Iterate {
    std::vector<double> gamma, velocity;
};

double first_step_length(const LcpProblem& problem, const Iterate& iterate) {
    const std::size_t count = iterate.gamma.size();
    std::vector<double> downhill(count), image(count);
    parallel_for(count, [&](std::size_t l) {
        const bool held = iterate.gamma[l] <= 0.0 && iterate.velocity[l] >= 0.0;
        downhill[l] = held ? 0.0 : iterate.velocity[l];
    });
    problem.matrix.apply(downhill, image);
    const double curvature = sum_of_products(downhill, image);
    if (curvature > 0.0) return sum_of_products(downhill, downhill) / curvature;
    // Downhill without end: any step will do, and the end of the search will tell the problem infeasible.
    const auto diagonal = problem.matrix.diagonal();
    const double largest = parallel_max(count, 0.0, [&](std::size_t l) { return diagonal[l]; });
    return largest > 0.0 ? 1.0 / largest : 1.0;
}

double next_step_length(const StepProducts& products, BarzilaiBorwein rule, std::uint64_t iteration, double last) {
    if (!(products.sy > 0.0)) return last;
    const bool use_bb1 = rule == BarzilaiBorwein::bb1 || (rule == BarzilaiBorwein::alternating && iteration % 2 == 1);
    return use_bb1 ? products.ss / products.sy : products.sy / products.yy;
}

/// Tells when the iteration runs in circles: no new best residual for a while.
class CycleWatch {
public:
    explicit CycleWatch(double residual) : best_(residual) {}
    /// Whether the short step should be taken now.
    bool circling(double residual) {
        ++since_best_;
        if (residual < best_) {
            best_ = residual;
            since_best_ = 0;
        }
        return since_best_ >= patience && since_best_ % 2 == 0;
    }

private:
    static constexpr int patience = 20;
    double best_;
    int since_best_ = 0;
};

}  // namespace

LcpResult solve_bbpgd(const LcpProblem& problem, const LcpSettings& settings, std::span<const double> start) {
    const std::size_t count = problem.matrix.size();
    const auto& b = problem.constant;
    Iterate now{std::vector<double>(start.begin(), start.end()), std::vector<double>(b.begin(), b.end())};
    now.gamma.resize(count, 0.0);
    LcpResult result;
    if (!start.empty()) {
        problem.matrix.apply(now.gamma, now.velocity);
        ++result.iterations;
        parallel_for(count, [&](std::size_t l) { now.velocity[l] += b[l]; });
    }
    result.residual = lcp_residual(problem, settings.residual, now.gamma, now.velocity);
    Iterate best;
    double best_residual = result.residual;
    bool finite = std::isfinite(result.residual);
    double step_length = 0.0;
    if (finite && result.residual > settings.tolerance && result.iterations < settings.max_iterations) {
        step_length = first_step_length(problem, now);
        ++result.iterations;
    }
    CycleWatch watch(result.residual);
    Iterate next{std::vector<double>(count), std::vector<double>(count)};
    while (finite && result.residual > settings.tolerance && result.iterations < settings.max_iterations) {
        parallel_for(
            count, [&](std::size_t l) { next.gamma[l] = std::max(now.gamma[l] - step_length * now.velocity[l], 0.0); });
        problem.matrix.apply(next.gamma, next.velocity);
        ++result.iterations;
        const auto products = parallel_sum<StepProducts>(count, [&](std::size_t l) {
            next.velocity[l] += b[l];
            const double s = next.gamma[l] - now.gamma[l];
            const double y = next.velocity[l] - now.velocity[l];
            return StepProducts{s * s, s * y, y * y};
        });
        std::swap(now, next);
        result.residual = lcp_residual(problem, settings.residual, now.gamma, now.velocity);
        finite = std::isfinite(result.residual);
        if (products.ss == 0.0) break;
        const BarzilaiBorwein rule = watch.circling(result.residual) ? BarzilaiBorwein::bb2 : settings.step_rule;
        step_length = next_step_length(products, rule, result.iterations, step_length);
        // Keeping the best iterate costs a copy, so only where the search has become long.
        if (result.iterations >= 200 && result.residual < best_residual) {
            best = now;
            best_residual = result.residual;
        }
    }
    if (result.residual > settings.tolerance && best_residual < result.residual && !best.gamma.empty()) {
        now = std::move(best);
        result.residual = best_residual;
    }
    result.solution = std::move(now.gamma);
    result.velocity = std::move(now.velocity);
    result.status = lcp_status(problem, settings, result);
    return result;
}

}  // namespace jostle
