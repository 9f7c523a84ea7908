#pragma once

#include <cstddef>
#include <span>

namespace jostle {

/// Where a series has come to equilibrium.
struct Equilibration {
    std::size_t start = 0;  ///< first row of production
    bool reached = false;   ///< false: still drifting, or too short to tell
};

/// The origin after which a series holds the largest effective number of samples (Chodera, J. Chem. Theory Comput. 12,
/// 1799 (2016)).
///
/// Early rows are worth keeping only while they add samples: a drift raises the correlation time more than it adds
/// rows. Tried are 101 origins, evenly spaced over the first half of the series (averaged to at most 1023 blocks). What
/// has not settled by then cannot be told from a slow fluctuation: `reached` is false if the best origin lies beyond
/// 2/5 of the series (a steady drift puts it near the half) or leaves fewer than 25 effective samples. A constant
/// series is in equilibrium from its first row. `series` (rows), evenly spaced in time. Linear in the number of rows.
Equilibration detect_equilibration(std::span<const double> series);

}  // namespace jostle
