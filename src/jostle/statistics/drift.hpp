#pragma once

#include <span>

namespace jostle {

/// The change of a series from its first row to its last, as a straight line has it.
struct Drift {
    double change = 0.0;
    double standard_error = 0.0;     ///< twice it covers 95 %; 0 for a series that is a straight line
    double effective_samples = 0.0;  ///< of the series without the line

    /// Whether the change is more than chance: beyond 2.5 standard errors, which a stationary series has once in 70
    /// times.
    bool is_significant() const;
};

/// The drift of a series: the change along the line of least squares, with an error that knows the correlation of the
/// rows.
///
/// Fluctuations are those about the line, for a drift counted as fluctuation would hide itself. Sharper than the first
/// half against the second: of 1000 independent rows it finds a drift by 16 standard errors of the mean in 96 of 100
/// cases, where halves find it in 90. `series` (rows), evenly spaced in time; fewer than 20 rows, or rows that
/// are not finite, give an infinite error.
Drift drift(std::span<const double> series);

}  // namespace jostle
