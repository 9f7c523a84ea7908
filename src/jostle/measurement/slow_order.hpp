#pragma once

#include <optional>

#include "jostle/measurement/production_window.hpp"
#include "jostle/run_files/series_file.hpp"
#include "jostle/statistics/time_series.hpp"

namespace jostle {

/// What pressures and stresses of turning rods follow slowly, in the rows of a window: S of a nematic, else Q:Q of the
/// order tensor, which knows no direction either and is smooth at 0. Its correlation time is that of its rows, and at
/// least that which belongs to the rotation time of the window: S forgets itself as Q does, Q:Q twice as fast. Of a
/// nematic that is known beforehand.
/// `row_time`: of a row. Empty where nothing turns, or where the rows do not tell how slowly.
std::optional<SlowColumn> slow_order(const ProductionWindow& window, const SeriesTable& series, double row_time,
                                     int dimensions);

}  // namespace jostle
