#pragma once

#include <nlohmann/json.hpp>

#include "jostle/run_files/series_file.hpp"
#include "jostle/scene/scene.hpp"
#include "jostle/simulation/simulation.hpp"

/// summary.json: averages over the window with error bars, and checks of the stress against what equilibrium has.
nlohmann::ordered_json summarise(const jostle::Scene& scene, const jostle::Simulation& simulation,
                                 const jostle::SeriesTable& series, double run_max_overlap);
