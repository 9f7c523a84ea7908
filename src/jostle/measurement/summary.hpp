#pragma once

#include <nlohmann/json.hpp>

#include "jostle/run_files/series_file.hpp"
#include "jostle/scene/scene.hpp"
#include "jostle/simulation/simulation.hpp"

namespace jostle {

/// summary.json: averages over the window with error bars, and checks of the stress against what equilibrium has.
/// `begin`: time at which the first row of the series begins. Errors: InputError if no row is of production, or no rod
/// is left.
nlohmann::ordered_json summarise(const Scene& scene, const Simulation& simulation, const SeriesTable& series,
                                 double run_max_overlap, double begin = 0.0);

}  // namespace jostle
