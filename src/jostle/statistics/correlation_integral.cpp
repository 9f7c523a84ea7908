#include "jostle/statistics/correlation_integral.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "jostle/statistics/columns.hpp"
#include "jostle/statistics/time_series.hpp"

namespace jostle {

namespace {

constexpr double growth_in_errors = 2.0;   // what more than this adds is no chance
constexpr std::size_t max_blocks = 1024;   // for the error of one window
constexpr std::size_t longer_windows = 2;  // that have to add nothing to the one which is read

/// x_t (x_t/2 + sum_k w_k x_(t+k)) for t = 0 ... rows - 1, mean over columns. With w_k = 1 up to `window`, and falling
/// to 0 at twice that: the mean of the sums up to K = window ... 2 window - 1.
std::vector<double> integrand(std::span<const std::vector<double>> columns, std::size_t window, std::size_t rows) {
    std::vector<double> mean(rows, 0.0);
    for (const std::vector<double>& x : columns) {
        double later = 0.0;  // sum over lags 1 ... window
        for (std::size_t k = 1; k <= window; ++k) later += x[k];
        double taper = 0.0;
        for (std::size_t k = 1; k < window; ++k)
            taper += static_cast<double>(window - k) / static_cast<double>(window) * x[window + k];
        double behind = 0.0;  // sum over lags window + 1 ... 2 window, which the taper gives up as t goes on
        for (std::size_t k = window + 1; k <= 2 * window; ++k) behind += x[k];
        for (std::size_t t = 0; t < rows; ++t) {
            mean[t] += x[t] * (0.5 * x[t] + later + taper);
            if (t + 1 == rows) break;
            // lag k of t + 1 is lag k + 1 of t
            taper += (behind - static_cast<double>(window) * x[t + window + 1]) / static_cast<double>(window);
            later += x[t + window + 1] - x[t + 1];
            behind += x[t + 2 * window + 1] - x[t + window + 1];
        }
    }
    for (double& value : mean) value /= static_cast<double>(columns.size());
    return mean;
}

/// Whether b is above a by more than chance.
bool is_more(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> difference(a.size());
    for (std::size_t k = 0; k < a.size(); ++k) difference[k] = b[k] - a[k];
    const Average grown = average(difference);
    if (!grown.standard_error) return grown.mean > 0.0;
    return grown.mean > growth_in_errors * *grown.standard_error;
}

CorrelationIntegral without_value(std::string reason) {
    CorrelationIntegral result;
    result.value = std::numeric_limits<double>::quiet_NaN();
    result.no_value_reason = std::move(reason);
    return result;
}

}  // namespace

CorrelationIntegral correlation_integral(std::span<const std::vector<double>> columns) {
    require_columns(columns);
    const std::size_t rows = columns[0].size();
    for (const auto& column : columns)
        if (!std::all_of(column.begin(), column.end(), [](double value) { return std::isfinite(value); }))
            return without_value("The series contains a value that is not finite.");
    std::size_t levels = 0;
    while (2 * least_windows * (std::size_t{1} << levels) <= rows) ++levels;
    if (levels < 2 + longer_windows)
        return without_value(fmt::format("The series has only {} rows; at least {} are needed.", rows,
                                         2 * least_windows << (1 + longer_windows)));
    const std::size_t longest = std::size_t{1} << (levels - 1), starts = rows - 2 * longest;
    const std::size_t block_length = std::max<std::size_t>(starts / max_blocks, 1);
    std::vector<std::vector<double>> blocks;  // of all windows from the same rows
    for (std::size_t level = 0; level < levels; ++level)
        blocks.push_back(block_means(integrand(columns, std::size_t{1} << level, starts), block_length));
    for (std::size_t first = 0; first + 1 + longer_windows < levels; ++first) {
        bool grows = false;
        for (std::size_t level = first + 1; level < levels && !grows; ++level)
            grows = is_more(blocks[first], blocks[level]);
        if (grows) continue;
        CorrelationIntegral result;
        result.window = std::size_t{1} << (first + 1);
        const Average found =
            average(block_means(integrand(columns, result.window, rows - 2 * result.window), block_length));
        if (!found.standard_error) return without_value(found.no_error_reason);
        result.value = found.mean;
        result.standard_error = found.standard_error;
        result.effective_samples = found.effective_samples;
        return result;
    }
    return without_value(
        fmt::format("What is summed still grows with windows of {} of {} rows: the series is too short.",
                    longest >> longer_windows, rows));
}

}  // namespace jostle
