#pragma once

#include <cstddef>

#include "jostle/run_files/series_file.hpp"
#include "jostle/scene/scene.hpp"
#include "jostle/statistics/equilibrium_check.hpp"

namespace jostle {

/// Which rows of the series are averaged over, and whether they are of equilibrium.
struct ProductionWindow {
    std::size_t first_row = 0;
    double equilibration_time = 0.0;
    EquilibriumCheck equilibrium;

    bool equilibrated() const { return equilibrium.verdict == EquilibriumCheck::Verdict::reached; }
};

/// Whether a schedule changes something within the window.
bool is_ramped(const Scene& scene, const ProductionWindow& window);

/// The window of production at the end of the series as it is, or where equilibration has to be found in it. `begin`:
/// time at which the first row begins.
ProductionWindow production_window(const Scene& scene, const SeriesTable& series, const FreeClocks& clocks,
                                   double begin = 0.0);

}  // namespace jostle
