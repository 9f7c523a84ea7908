#include "jostle/statistics/equilibration.hpp"

#include <algorithm>

#include "jostle/statistics/time_series.hpp"

namespace jostle {

namespace {

constexpr std::size_t largest_number_of_blocks = 512;  // so that a hundred correlation times cost no more than a few
constexpr std::size_t intervals = 100;

/// From one window alone: it scatters less than `average`, which errs on the safe side.
double effective_samples(std::span<const double> series) {
    const std::vector<double> column(series.begin(), series.end());
    return static_cast<double>(series.size()) / (2.0 * correlation_time(std::span(&column, 1)));
}

}  // namespace

Equilibration detect_equilibration(std::span<const double> series) {
    const std::size_t block_length = std::max<std::size_t>(series.size() / largest_number_of_blocks, 1);
    const std::vector<double> blocks = block_means(series, block_length);
    const std::size_t left_out = series.size() - blocks.size() * block_length;
    const std::size_t half = blocks.size() / 2;
    std::size_t best = 0;
    double max_samples = 0.0;
    for (std::size_t k = 0; k <= intervals; ++k) {
        const std::size_t origin = k * half / intervals;
        if (k > 0 && origin == (k - 1) * half / intervals) continue;  // a short series has fewer origins
        const double samples = effective_samples(std::span(blocks).subspan(origin));
        if (samples > max_samples) {
            max_samples = samples;
            best = origin;
        }
    }
    const std::size_t start = best == 0 ? 0 : left_out + best * block_length;
    const bool settled = 5 * best <= 2 * blocks.size() && max_samples >= least_effective_samples;
    return {start, settled};
}

}  // namespace jostle
