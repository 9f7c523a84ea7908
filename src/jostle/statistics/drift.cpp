#include "jostle/statistics/drift.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "jostle/statistics/student_t.hpp"
#include "jostle/statistics/time_series.hpp"

namespace jostle {

namespace {

constexpr double significant = 2.5;   // in standard errors
constexpr double negligible = 1e-12;  // change, in the largest value: rounding

/// Of the mean, however few samples there are.
double error_of_mean(const Average& average, double rows) {
    if (average.standard_deviation == 0.0 || average.effective_samples == 0.0) return 0.0;
    const double inside = average.standard_deviation * average.standard_deviation * (rows - 1.0) / rows;
    const double squared = inside / (average.effective_samples - 1.0);  // the variance is that inside and this
    return std::sqrt(squared) * widening(average.effective_samples / samples_per_degree_of_freedom);
}

}  // namespace

bool Drift::is_significant() const {
    return std::fabs(change) > significant * standard_error;
}

Drift drift(std::span<const double> series) {
    Drift result;
    const auto n = static_cast<double>(series.size());
    result.standard_error = std::numeric_limits<double>::infinity();
    if (n < least_effective_samples ||
        !std::all_of(series.begin(), series.end(), [](double value) { return std::isfinite(value); }))
        return result;
    double sum = 0.0, squares = 0.0;
    for (std::size_t k = 0; k < series.size(); ++k) {
        const double time = static_cast<double>(k) - 0.5 * (n - 1.0);
        sum += time * series[k];
        squares += time * time;
    }
    const double slope = sum / squares;
    std::vector<double> rest(series.begin(), series.end());
    for (std::size_t k = 0; k < rest.size(); ++k) rest[k] -= slope * (static_cast<double>(k) - 0.5 * (n - 1.0));
    const Average of_rest = average(rest);
    const auto [least, most] = std::minmax_element(series.begin(), series.end());
    result.change = slope * (n - 1.0);
    if (std::fabs(result.change) <= negligible * std::max(std::fabs(*least), std::fabs(*most))) result.change = 0.0;
    result.effective_samples = of_rest.effective_samples;
    // The slope of a line through n rows has sqrt(12/n^2) times the error of their mean.
    result.standard_error = std::sqrt(12.0) * error_of_mean(of_rest, n);
    return result;
}

}  // namespace jostle
