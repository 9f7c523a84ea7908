#include "jostle/lcp/bbpgd.hpp"

#include <algorithm>

#include "jostle/lcp/lcp_search.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

double next_step_length(const StepProducts& products, BarzilaiBorwein rule, std::uint64_t iteration, double last) {
    if (!(products.sy > 0.0)) return last;
    const bool use_bb1 = rule == BarzilaiBorwein::bb1 || (rule == BarzilaiBorwein::alternating && iteration % 2 == 1);
    return use_bb1 ? products.ss / products.sy : products.sy / products.yy;
}

}  // namespace

LcpResult solve_bbpgd(const LcpProblem& problem, const LcpSettings& settings, std::span<const double> start) {
    const auto& b = problem.constant;
    LcpSearch search(problem, settings, start);
    double step_length = search.unsolved() ? first_step_length(search, {}) : 0.0;
    while (search.unsolved()) {
        const LcpIterate& now = search.current();
        LcpIterate& next = search.next();
        parallel_for(b.size(), [&](std::size_t l) {
            next.gamma[l] = std::max(now.gamma[l] - step_length * now.velocity[l], 0.0);
        });
        search.apply(next.gamma, next.velocity);
        const auto products = parallel_sum<StepProducts>(b.size(), [&](std::size_t l) {
            next.velocity[l] += b[l];
            const double s = next.gamma[l] - now.gamma[l];
            const double y = next.velocity[l] - now.velocity[l];
            return StepProducts{s * s, s * y, y * y};
        });
        search.advance();
        if (products.ss == 0.0) break;
        const BarzilaiBorwein rule = search.circling() ? BarzilaiBorwein::bb2 : settings.step_rule;
        step_length = next_step_length(products, rule, search.applications(), step_length);
    }
    return search.result();
}

}  // namespace jostle
