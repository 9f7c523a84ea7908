#pragma once

#include <cstddef>

#include "jostle/io/series_file.hpp"
#include "jostle/simulation/scene.hpp"

/// Which rows of the series are averaged over.
struct ProductionWindow {
    std::size_t first_row = 0;
    double equilibration_time = 0.0;
    bool equilibrated = true;  ///< false: it was to be detected, and was not
};

/// The window of production at the end of the series as it is, or where equilibration has to be found in it.
ProductionWindow production_window(const jostle::Scene& scene, const jostle::SeriesTable& series);
