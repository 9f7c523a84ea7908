#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace jostle {

/// The integral of an autocorrelation, and how well it is known.
struct CorrelationIntegral {
    double value = 0.0;                    ///< in rows; not a number where it cannot be given
    std::optional<double> standard_error;  ///< empty where it cannot be given
    double effective_samples = 0.0;        ///< independent values of the integrand x_t (x_t/2 + sum_k w_k x_(t+k))
    std::size_t window = 0;                ///< rows up to which all lags count in full; up to twice as many in part
    std::string no_value_reason;           ///< one sentence where there is no value
};

/// Windows of the longest length that a series has to hold, each with its taper: 24 rows for every row of it.
inline constexpr std::size_t least_windows = 12;

/// Half of <x^2> and all of <x_t x_(t + k)>, k >= 1, summed: the integral of the autocorrelation of stationary columns
/// of mean 0 that all have the same one, such as the elements of an isotropic tensor. It is T/2 times the mean square
/// of means over long times T (Helfand), without the error of 1/T which that has.
///
/// The sum counts lags up to a window in full, those up to twice it less and less (flat-top window: Politis & Romano,
/// J. Time Ser. Anal. 16, 67 (1995)). Tried are windows of 1, 2, 4, ... rows, up to the longest of which the series
/// holds 12 with their tapers. In equilibrium without inertia an autocorrelation is positive, so that sums can only
/// grow with the window. The value is that of the window twice as long as the first beyond which no longer one adds
/// more than two standard errors, where at least two longer ones could be tried. If there is none: no value. Nothing in
/// this is to be set.
/// `columns` (columns, rows), all of one length. Throws InputError if there is no column, or lengths differ.
CorrelationIntegral correlation_integral(std::span<const std::vector<double>> columns);

}  // namespace jostle
