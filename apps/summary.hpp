#pragma once

#include <nlohmann/json.hpp>

#include "jostle/io/series_file.hpp"
#include "jostle/simulation/scene.hpp"
#include "jostle/simulation/simulation.hpp"

/// Which rows of the series are averaged over.
struct ProductionWindow {
    std::size_t first_row = 0;
    double equilibration_time = 0.0;
    bool equilibrated = true;  ///< false: it was to be detected, and was not
};

/// The window of production at the end of the series as it is, or where equilibration has to be found in it.
ProductionWindow production_window(const jostle::Scene& scene, const jostle::SeriesTable& series);

/// summary.json: averages over the window with error bars, and the check of the anisotropy against theory.
nlohmann::ordered_json summarise(const jostle::Scene& scene, const jostle::Simulation& simulation,
                                 const jostle::SeriesTable& series, double run_max_overlap);

/// The summary as a few lines to read.
std::string summary_text(const nlohmann::ordered_json& summary);
