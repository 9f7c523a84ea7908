#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace jostle {

/// Below this effective number of samples, fifty correlation times, no error bar is given. The number itself is an
/// estimate, too large just for the series that seem to be long enough: of series worth ten samples fewer than one in
/// ten seem to be worth 25.
inline constexpr double least_effective_samples = 25.0;

/// How many of them make one degree of freedom of the error itself: the window is that long.
inline constexpr double samples_per_degree_of_freedom = 3.0;

/// The mean of a correlated time series, and how well it is known.
struct Average {
    double mean = 0.0;                     ///< not a number for an empty series
    std::optional<double> standard_error;  ///< of the mean: twice it covers 95 %; empty where it cannot be given
    double effective_samples = 0.0;        ///< rows/(2 correlation_time): as many independent rows would serve as well
    double standard_deviation = 0.0;       ///< of the rows inside the series: a fluctuation, not an error
    double correlation_time = 0.0;         ///< integrated, in rows: 1/2 + sum_k C(k); 1/2 for independent rows
    std::string no_error_reason;           ///< one sentence where standard_error is empty
};

/// Mean, standard error and correlation time of a stationary series in O(rows).
///
/// With g = 1 + 2 sum_k (1 - k/n) C(k) the statistical inefficiency, the variance of the mean is g variance/n. The sum
/// ends at the first lag beyond 3 correlation times (Madras & Sokal, J. Stat. Phys. 50, 109 (1988)), never beyond a
/// quarter of the series. The known bias of C(k) from the mean of the same series is removed. Departures, all on the
/// safe side:
/// 1. The series is halved again and again by averaging neighbours, down to 16 blocks (Flyvbjerg & Petersen, J. Chem.
///    Phys. 91, 461 (1989)), and the largest variance of all levels is taken: the window alone stops too soon where a
///    slow mode hides below fast noise, as structure does below collisions.
/// 2. g is at least 1: an error smaller than that of independent rows is never claimed.
/// 3. The variance of the mean is itself known from n_eff/3 degrees of freedom. `standard_error` is half of the half
///    width of Student's interval, so that the mean +- twice it holds the truth in 95 of 100 cases, few samples or
///    many.
/// `series` (rows), evenly spaced in time. No error bar (and a reason) where the series is empty, constant, not finite,
/// or has fewer than `least_effective_samples`. It cannot see a mode that is slower than the series is long.
Average average(std::span<const double> series);

/// A column that changes slowly, as the order of the rods does, and that others follow in part.
struct SlowColumn {
    std::vector<double> rows;
    double correlation_time = 0.0;  ///< integrated, in rows
    bool time_is_known = false;     ///< beforehand, and not from these rows
};

/// The same of a series that follows a slow column x of the same rows:
///
///     y = <y> + b (x - <x>) + rest,   b by least squares,
///     squared error = that of the rest + b^2 (variance of x) (2 tau/n)/(1 - 2 tau/n),
///
/// each widened by Student's t of its own samples, or that of the series alone, whichever is larger. Of x these are
/// n/(2 tau) - 1 degrees of freedom if tau is known, else a third of n/(2 tau). A slow part of a few per cent of the
/// variance is below the noise of y. x shows it without noise, and tau may be known better than by rows of y.
Average average(std::span<const double> series, const SlowColumn& slow);

/// The integrated correlation time, in rows, of several columns that fluctuate together, such as the elements of a
/// tensor: from the sum of their autocovariances, which is known the better the more columns there are.
///
/// `columns` (columns, rows), all of one length. Averaged to at most 1023 blocks; a time below half a block is not
/// resolved, and half a block then. Infinity where the window of 3 correlation times does not close within a quarter of
/// the series, that is where the series is shorter than 12 of them. Throws InputError if there is no column, or lengths
/// differ.
double correlation_time(std::span<const std::vector<double>> columns);

/// Means of consecutive blocks of `block_length` rows; the first rows are left out where the last block would not be
/// full.
///
/// Throws InputError if `block_length` is 0.
std::vector<double> block_means(std::span<const double> series, std::size_t block_length);

}  // namespace jostle
