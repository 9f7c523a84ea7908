#pragma once

#include <algorithm>
#include <optional>
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
    std::optional<SlowColumn> slow_order;

    std::size_t first() const { return window.first_row; }
    std::size_t production_rows() const { return series.rows() - std::min(first(), series.rows()); }
    int dimensions() const { return simulation.box().dimensions(); }
    bool is_thermal() const { return simulation.settings().kT > 0.0; }
    bool has_springs() const { return !scene.springs.file.empty(); }
    std::vector<double> column(const std::string& name) const { return from_row(series.column(name), first()); }
    Columns columns(std::span<const char* const> names) const { return window_columns(series, first(), names); }
    /// Of rows of the window, which may follow the order.
    Average average_of(const std::vector<double>& rows) const {
        return slow_order ? average(rows, *slow_order) : average(rows);
    }
    Average average_of(const std::string& name) const { return average_of(column(name)); }
    /// Of nine columns in the window.
    nlohmann::ordered_json stress_entry(const Columns& tensor) const {
        return tensor_entry(tensor, stress_unit, [this](const auto& rows) { return average_of(rows); });
    }
};

}  // namespace jostle
