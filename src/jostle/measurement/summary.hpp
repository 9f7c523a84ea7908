#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "jostle/run_files/series_file.hpp"
#include "jostle/scene/scene.hpp"
#include "jostle/simulation/simulation.hpp"
#include "jostle/statistics/time_series.hpp"

namespace jostle {

/// summary.json: averages over the window with error bars, and checks of the stress against what equilibrium has.
/// `begin`: time at which the first row of the series begins. Errors: InputError if no row is of production, or no rod
/// is left.
nlohmann::ordered_json summarise(const Scene& scene, const Simulation& simulation, const SeriesTable& series,
                                 double run_max_overlap, double begin = 0.0);

/// The average of rows of something else in the same window, with the error bar of the averages there: beside the order
/// that pressures follow. `rows` (production_rows of the summary): not a number where a row has none, which is left
/// out. Errors: as above, and InputError for another number of rows.
Average average_in_window(const Scene& scene, const Simulation& simulation, const SeriesTable& series,
                          std::span<const double> rows, double begin = 0.0);

}  // namespace jostle
