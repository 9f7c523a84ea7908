#include "jostle/lcp/adaptive_bb.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "jostle/lcp/lcp_search.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

/// The step lengths, one after the other.
class AdaptiveStepLength {
public:
    explicit AdaptiveStepLength(double first) : length_(first) { short_steps_.fill(first); }
    double length() const { return length_; }

    void update(const StepProducts& products, bool circling) {
        const double long_step = products.ss / products.sy, short_step = products.sy / products.yy;
        if (!(products.sy > 0.0) || !std::isfinite(long_step) || !(short_step > 0.0)) return;
        short_steps_[count_++ % short_steps_.size()] = short_step;
        const bool take_short = short_step < threshold_ * long_step;
        threshold_ *= take_short ? 0.9 : 1.1;
        length_ = take_short || circling ? *std::min_element(short_steps_.begin(), short_steps_.end()) : long_step;
    }

private:
    std::array<double, 3> short_steps_;  ///< the last ones
    std::size_t count_ = 0;              ///< of short steps so far
    double threshold_ = 0.5;
    double length_;
};

}  // namespace

LcpResult solve_adaptive_bb(const LcpProblem& problem, const LcpSettings& settings, std::span<const double> start) {
    const auto& b = problem.constant;
    LcpSearch search(problem, settings, start);
    if (!search.unsolved()) return search.result();
    const std::vector<double> weight = inverse_diagonal(problem.matrix);
    AdaptiveStepLength step(first_step_length(search, weight));
    while (search.unsolved()) {
        const LcpIterate& now = search.current();
        LcpIterate& next = search.next();
        parallel_for(b.size(), [&](std::size_t l) {
            next.gamma[l] = std::max(now.gamma[l] - step.length() * weight[l] * now.velocity[l], 0.0);
        });
        search.apply(next.gamma, next.velocity);
        const auto products = parallel_sum<StepProducts>(b.size(), [&](std::size_t l) {
            next.velocity[l] += b[l];
            const double s = next.gamma[l] - now.gamma[l];
            const double y = next.velocity[l] - now.velocity[l];
            return s == 0.0 ? StepProducts{} : StepProducts{s * s / weight[l], s * y, y * y * weight[l]};
        });
        search.advance();
        if (products.ss == 0.0) break;
        step.update(products, search.circling());
    }
    return search.result();
}

}  // namespace jostle
