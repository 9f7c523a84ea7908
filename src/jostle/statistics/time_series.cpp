#include "jostle/statistics/time_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "jostle/error/refuse.hpp"
#include "jostle/statistics/columns.hpp"
#include "jostle/statistics/student_t.hpp"

namespace jostle {

namespace {

constexpr double window_in_correlation_times = 3.0;
constexpr std::size_t largest_lag = 128;              // longer windows are found on a coarser level
constexpr std::size_t fewest_blocks = 16;             // of the coarsest level
constexpr std::size_t max_blocks_for_a_drift = 1023;  // so that a search for a drift costs no more than a few sums

struct MeanError {
    double squared_error = 0.0;  // variance of the mean
    bool closed = false;         // the window closed, or only more rows could close it
};

/// The second pass takes back the rounding of the first, which grows with the number of rows.
double mean_of(std::span<const double> values) {
    const auto n = static_cast<double>(values.size());
    double sum = 0.0, rest = 0.0;
    for (double value : values) sum += value;
    for (double value : values) rest += value - sum / n;
    return sum / n + rest / n;
}

/// sum_i x_i x_(i + lag)/(n - lag); four sums side by side, for one would wait for its own additions.
double autocovariance(const std::vector<double>& series, std::size_t lag) {
    const std::size_t terms = series.size() - lag;
    const double* x = series.data();
    double sums[4] = {0.0, 0.0, 0.0, 0.0};
    std::size_t i = 0;
    for (; i + 4 <= terms; i += 4)
        for (std::size_t k = 0; k < 4; ++k) sums[k] += x[i + k] * x[i + k + lag];
    for (; i < terms; ++i) sums[0] += x[i] * x[i + lag];
    return ((sums[0] + sums[1]) + (sums[2] + sums[3])) / static_cast<double>(terms);
}

void subtract_mean(std::vector<double>& series) {
    const double mean = mean_of(series);
    for (double& value : series) value -= mean;
}

/// Variance of the mean from the autocovariances at lags 0, 1, ... inside a window that their own correlation time
/// chooses.
///
/// With V the variance of the mean, the measured autocovariance is too small by V at every lag. So V = (sum of
/// (1 - |k|/n)(measured + V) over |k| <= window)/n, which is solved for V.
template <class Autocovariance>
MeanError windowed(std::size_t rows, std::size_t last_lag, const Autocovariance& measured) {
    const auto n = static_cast<double>(rows);
    const double measured_variance = measured(0);
    double covariance_sum = measured_variance, weight_sum = 1.0;
    MeanError result;
    for (std::size_t lag = 1; lag <= last_lag && !result.closed; ++lag) {
        const double weight = 1.0 - static_cast<double>(lag) / n;
        covariance_sum += 2.0 * weight * measured(lag);
        weight_sum += 2.0 * weight;
        result.squared_error = covariance_sum / (n - weight_sum);
        const double time = 0.5 * n * result.squared_error / (measured_variance + result.squared_error);
        result.closed = static_cast<double>(lag) >= window_in_correlation_times * time;
    }
    return result;
}

/// Variance of the mean of one level. A window that is still open at n/4 means fewer than six effective samples, so
/// that no error bar follows.
MeanError mean_error(std::vector<double> level) {
    subtract_mean(level);
    const std::size_t last_lag = std::min(largest_lag, level.size() / 4);
    MeanError result = windowed(level.size(), last_lag, [&](std::size_t lag) { return autocovariance(level, lag); });
    result.closed = result.closed || last_lag < largest_lag;
    return result;
}

/// Variance of the mean of a series: the largest of all levels whose window is closed.
double squared_error_of_mean(std::span<const double> series) {
    std::vector<double> level(series.begin(), series.end());
    double largest = 0.0;
    for (bool closed = false;;) {
        const MeanError found = mean_error(level);
        if (found.closed) largest = std::max(largest, found.squared_error);
        closed = closed || found.closed;
        if (closed && level.size() / 2 < fewest_blocks) return largest;
        level = block_means(level, 2);
    }
}

Average without_error(Average average, std::string reason) {
    average.standard_error.reset();
    average.no_error_reason = std::move(reason);
    return average;
}

std::string too_few_samples(double samples) {
    return fmt::format("The series is worth {:.1f} independent rows; at least {} are needed.", samples,
                       least_effective_samples);
}

/// Variance of the mean, and what it is multiplied by for the few samples that it is known from.
struct KnownError {
    double squared_error = 0.0, widening = 1.0;

    double widened() const { return squared_error * widening * widening; }
};

/// b of y = <y> + b (x - <x>), and the variance of x. x is not constant.
struct Regression {
    double slope = 0.0, variance = 0.0;

    Regression(std::span<const double> y, std::span<const double> x) {
        const double mean = mean_of(x), mean_y = mean_of(y);
        double product = 0.0, square = 0.0;
        for (std::size_t k = 0; k < x.size(); ++k) {
            product += (x[k] - mean) * (y[k] - mean_y);
            square += (x[k] - mean) * (x[k] - mean);
        }
        slope = product / square;
        variance = square / static_cast<double>(x.size());
    }
};

/// What a series of so many rows is worth if the variance of its mean is `squared_error`.
double effective_samples(double variance_of_rows, double squared_error, double rows) {
    return std::min(rows, (variance_of_rows + squared_error) / squared_error);
}

/// Of what of y does not follow x.
KnownError error_of_rest(std::span<const double> y, std::span<const double> x, double slope) {
    std::vector<double> rest(y.begin(), y.end());
    double squares = 0.0;
    const double mean = mean_of(x);
    for (std::size_t k = 0; k < rest.size(); ++k) rest[k] -= slope * (x[k] - mean);
    const double mean_of_rest = mean_of(rest);
    for (const double value : rest) squares += (value - mean_of_rest) * (value - mean_of_rest);
    const auto n = static_cast<double>(rest.size());
    const double squared_error = std::max(squared_error_of_mean(rest), squares / (n * n));
    if (squared_error == 0.0) return {};  // y is linear in x
    return {squared_error, widening(effective_samples(squares / n, squared_error, n) / samples_per_degree_of_freedom)};
}

/// Of b times the mean of x, which is worth so many samples.
KnownError error_of_slow_part(const Regression& regression, double samples, bool time_is_known) {
    return {regression.slope * regression.slope * regression.variance / (samples - 1.0),
            widening(time_is_known ? samples - 1.0 : samples / samples_per_degree_of_freedom)};
}

}  // namespace

Average average(std::span<const double> series) {
    Average result;
    const auto n = static_cast<double>(series.size());
    result.mean = series.empty() ? std::numeric_limits<double>::quiet_NaN() : mean_of(series);
    if (series.empty()) return without_error(result, "The series has no rows.");
    if (!std::all_of(series.begin(), series.end(), [](double value) { return std::isfinite(value); }))
        return without_error(result, "The series contains a value that is not finite.");
    double squares = 0.0;
    for (double value : series) squares += (value - result.mean) * (value - result.mean);
    result.standard_deviation = series.size() > 1 ? std::sqrt(squares / (n - 1.0)) : 0.0;
    if (n < least_effective_samples)
        return without_error(result,
                             fmt::format("The series has only {} rows; at least {} independent ones are needed.", n,
                                         least_effective_samples));
    const auto [smallest, largest] = std::minmax_element(series.begin(), series.end());
    const double rounding = 1e-14 * std::max(std::fabs(*smallest), std::fabs(*largest));
    if (*largest - *smallest <= rounding) return without_error(result, "The series is constant.");

    const double squared_error = squared_error_of_mean(series);
    const double variance = squares / n + squared_error;  // the measured one is too small by that of the mean
    const double inefficiency = std::max(1.0, n * squared_error / variance);
    result.correlation_time = 0.5 * inefficiency;
    result.effective_samples = n / inefficiency;
    if (result.effective_samples < least_effective_samples)
        return without_error(result, too_few_samples(result.effective_samples));
    result.standard_error =
        std::sqrt(variance * inefficiency / n) * widening(result.effective_samples / samples_per_degree_of_freedom);
    return result;
}

Average average(std::span<const double> series, const SlowColumn& slow) {
    require_columns(std::vector{std::vector(series.begin(), series.end()), slow.rows});
    Average result = average(series);
    if (!result.standard_error) return result;
    const auto n = static_cast<double>(series.size());
    const Regression regression(series, slow.rows);
    const double samples = n / (2.0 * slow.correlation_time);
    if (!std::isfinite(regression.slope)) return result;  // x is constant
    if (!(samples > 1.0))
        return without_error(result, "The series is shorter than what it follows slowly takes to change.");
    const KnownError rest = error_of_rest(series, slow.rows, regression.slope);
    const KnownError followed = error_of_slow_part(regression, samples, slow.time_is_known);
    const double widened = std::sqrt(rest.widened() + followed.widened());
    if (widened <= *result.standard_error) return result;
    const double deviation = result.standard_deviation;
    result.effective_samples = std::min(
        result.effective_samples,
        effective_samples(deviation * deviation * (n - 1.0) / n, rest.squared_error + followed.squared_error, n));
    result.correlation_time = 0.5 * n / result.effective_samples;
    if (result.effective_samples < least_effective_samples)
        return without_error(result, too_few_samples(result.effective_samples));
    result.standard_error = widened;
    return result;
}

double correlation_time(std::span<const std::vector<double>> columns) {
    require_columns(columns);
    const std::size_t block_length = columns[0].size() / max_blocks_for_a_drift + 1;
    std::vector<std::vector<double>> blocks;
    for (const auto& column : columns) {
        blocks.push_back(block_means(column, block_length));
        subtract_mean(blocks.back());
    }
    const auto measured = [&](std::size_t lag) {
        double sum = 0.0;
        for (const auto& column : blocks) sum += autocovariance(column, lag);
        return sum;
    };
    const std::size_t count = blocks[0].size();
    if (count < 4) return std::numeric_limits<double>::infinity();
    const double inside = measured(0);
    if (inside == 0.0) return 0.5 * static_cast<double>(block_length);
    const MeanError found = windowed(count, count / 4, measured);
    if (!found.closed) return std::numeric_limits<double>::infinity();
    const double in_blocks =
        std::max(0.5, 0.5 * static_cast<double>(count) * found.squared_error / (inside + found.squared_error));
    return in_blocks * static_cast<double>(block_length);
}

std::vector<double> block_means(std::span<const double> series, std::size_t block_length) {
    if (block_length == 0) {
        refuse("block_length", "0", "a block must have rows", ">= 1");
    }
    const std::size_t blocks = series.size() / block_length;
    const std::size_t left_out = series.size() - blocks * block_length;
    std::vector<double> means(blocks);
    for (std::size_t k = 0; k < blocks; ++k)
        means[k] = mean_of(series.subspan(left_out + k * block_length, block_length));
    return means;
}

}  // namespace jostle
