#pragma once

#include "jostle/measurement/production_window.hpp"
#include "jostle/measurement/summary_entries.hpp"
#include "jostle/scene/scene.hpp"
#include "jostle/setup/free_clocks.hpp"
#include "jostle/simulation/simulation.hpp"

namespace jostle {

/// The viscosity of thermal rods from the fluctuations of their stress at rest (theory, section 8): mean, standard
/// error, unit and definition, and the time of the window that it was read at. Where it does not hold, or the run is
/// too short: a mean of null, and the reason. `stress`: the nine columns of the whole stress from the window's first
/// row on; `row_time`: the time between rows.
nlohmann::ordered_json viscosity_at_rest_entry(const Scene& scene, const Simulation& simulation,
                                               const ProductionWindow& window, const Columns& stress, double row_time,
                                               double nematic_order, const FreeClocks& clocks);

}  // namespace jostle
