#pragma once

#include <string>

#include "jostle/measurement/production_window.hpp"
#include "jostle/measurement/summary_entries.hpp"
#include "jostle/scene/scene.hpp"
#include "jostle/setup/free_clocks.hpp"
#include "jostle/simulation/simulation.hpp"

namespace jostle {

/// What the parts of a summary are made from. Holds references.
struct SummarisedRun {
    const Scene& scene;
    const Simulation& simulation;
    const SeriesTable& series;
    double begin;  ///< time at which the first row begins
    FreeClocks clocks;
    ProductionWindow window;
    bool ramped;  ///< a schedule changes something within the window
    std::string stress_unit;
    Columns stress, collision;  ///< (9) of the whole stress and of the collision stress, in the window
    Columns order;              ///< (6) of the order tensor

    std::size_t first() const { return window.first_row; }
    int dimensions() const { return simulation.box().dimensions(); }
    bool is_thermal() const { return simulation.settings().kT > 0.0; }
    bool has_springs() const { return !scene.springs.file.empty(); }
    std::vector<double> column(const std::string& name) const { return from_row(series.column(name), first()); }
    Columns columns(std::span<const char* const> names) const { return window_columns(series, first(), names); }
    Average average_of(const std::string& name) const { return average(column(name)); }
};

}  // namespace jostle
