#include "jostle/statistics/jackknife.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "jostle/statistics/columns.hpp"
#include "jostle/statistics/time_series.hpp"

namespace jostle {

namespace {

constexpr std::size_t number_of_blocks = 1024;

std::vector<double> means_of(std::span<const std::vector<double>> columns) {
    std::vector<double> means;
    for (const auto& column : columns)
        means.push_back(column.empty() ? std::numeric_limits<double>::quiet_NaN()
                                       : block_means(column, column.size()).front());
    return means;
}

std::vector<double> pseudo_values(std::span<const std::vector<double>> blocks,
                                  const std::function<double(std::span<const double>)>& function) {
    const std::size_t count = blocks[0].size();
    const auto m = static_cast<double>(count);
    const std::vector<double> means = means_of(blocks);
    const double value = function(means);
    std::vector<double> values(count), without_one(blocks.size());
    for (std::size_t k = 0; k < count; ++k) {
        for (std::size_t c = 0; c < blocks.size(); ++c)
            without_one[c] = means[c] + (means[c] - blocks[c][k]) / (m - 1.0);
        values[k] = m * value - (m - 1.0) * function(without_one);
    }
    return values;
}

}  // namespace

Estimate jackknife(std::span<const std::vector<double>> columns,
                   const std::function<double(std::span<const double>)>& function) {
    require_columns(columns);
    const std::size_t rows = columns[0].size();
    Estimate result;
    result.value = function(means_of(columns));
    if (static_cast<double>(rows) < least_effective_samples || !std::isfinite(result.value)) {
        result.no_error_reason = std::isfinite(result.value) ? "The series are too short for an error bar."
                                                             : "The function of the means is not finite.";
        return result;
    }
    const std::size_t block_length = std::max<std::size_t>(rows / number_of_blocks, 1);
    std::vector<std::vector<double>> blocks;
    for (const auto& column : columns) blocks.push_back(block_means(column, block_length));
    const Average error = average(pseudo_values(blocks, function));
    result.standard_error = error.standard_error;
    result.effective_samples = error.effective_samples;
    result.no_error_reason = error.no_error_reason;
    return result;
}

}  // namespace jostle
