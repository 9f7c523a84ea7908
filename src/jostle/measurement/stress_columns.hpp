#pragma once

#include <array>

#include "jostle/math/mat3.hpp"
#include "jostle/measurement/summary_entries.hpp"
#include "jostle/run_files/series_file.hpp"

namespace jostle {

/// A stress tensor of nine means, by rows.
Mat3 stress_of(std::span<const double> means);

/// The nine columns of a symmetric tensor, from the six of the series with these names, from row `first` on.
Columns symmetric_columns(const SeriesTable& series, std::size_t first, const std::array<const char*, 6>& names);

/// The nine columns of the orientation stress, from the six of the series, from row `first` on.
Columns orientation_stress_columns(const SeriesTable& series, std::size_t first);

/// The nine columns of the whole stress (theory, eq. 1.19), from row `first` on: n kT on the diagonal, orientation
/// stress, collision stress, and that of springs and of torques where there are some. In two dimensions there is none
/// along z.
Columns total_stress_columns(const SeriesTable& series, std::size_t first, bool springs, bool torques, int dimensions);

/// The mean of n kT, from row `first` on.
double kinetic_pressure(const SeriesTable& series, std::size_t first, bool springs);

}  // namespace jostle
