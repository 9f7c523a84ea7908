#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace jostle {

/// Below this effective number of samples no error bar is given: it would be too uncertain itself to be believed.
inline constexpr double least_effective_samples = 10.0;

/// The mean of a correlated time series, and how well it is known.
struct Average {
    double mean = 0.0;                     ///< not a number for an empty series
    std::optional<double> standard_error;  ///< of the mean, corrected for correlation; empty where it cannot be given
    double effective_samples = 0.0;        ///< rows/(2 correlation_time): as many independent rows would serve as well
    double standard_deviation = 0.0;       ///< of the rows inside the series: a fluctuation, not an error
    double correlation_time = 0.0;         ///< integrated, in rows: 1/2 + sum_k C(k); 1/2 for independent rows
    std::string no_error_reason;           ///< one sentence where standard_error is empty
};

/// Mean, standard error and correlation time of a stationary series in O(rows).
///
/// With g = 1 + 2 sum_k (1 - k/n) C(k) the statistical inefficiency, the standard error is sqrt(g variance/n). The sum
/// ends at the first lag beyond 5 correlation times (Madras & Sokal, J. Stat. Phys. 50, 109 (1988)), never beyond a
/// quarter of the series. The known bias of C(k) from the mean of the same series is removed. Departures, both on the
/// safe side:
/// 1. The series is halved again and again by averaging neighbours (Flyvbjerg & Petersen, J. Chem. Phys. 91, 461
/// (1989)).
///    A coarser level replaces the result where its error is larger by more than two of its own standard deviations:
///    the window alone stops too soon where a slow mode hides below fast noise, as structure does below collisions.
/// 2. g is at least 1: an error smaller than that of independent rows is never claimed.
/// `series` (rows), evenly spaced in time. No error bar (and a reason) where the series is empty, constant, not finite,
/// or has fewer than `least_effective_samples`.
Average average(std::span<const double> series);

/// Means of consecutive blocks of `block_length` rows; the first rows are left out where the last block would not be
/// full.
///
/// Throws InputError if `block_length` is 0.
std::vector<double> block_means(std::span<const double> series, std::size_t block_length);

}  // namespace jostle
