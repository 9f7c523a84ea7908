#pragma once

#include <nlohmann/json.hpp>

#include "jostle/run_files/series_file.hpp"
#include "jostle/scene/scene.hpp"
#include "jostle/simulation/simulation.hpp"

namespace jostle {

/// summary.json: averages over the window with error bars, and checks of the stress against what equilibrium has.
nlohmann::ordered_json summarise(const Scene& scene, const Simulation& simulation, const SeriesTable& series,
                                 double run_max_overlap);

}  // namespace jostle
