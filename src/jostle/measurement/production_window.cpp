#include "jostle/measurement/production_window.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "jostle/measurement/stress_columns.hpp"
#include "jostle/measurement/summary_entries.hpp"
#include "jostle/scene/pressure_control.hpp"
#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/schedule.hpp"
#include "jostle/statistics/equilibration.hpp"
#include "jostle/stress/column_names.hpp"

namespace jostle {

namespace {

using Verdict = EquilibriumCheck::Verdict;

/// Rows are means over the steps before them: the first of the window begins at the end of equilibration or later.
std::size_t first_row_after(const std::vector<double>& time, double begin, double equilibration) {
    std::size_t row = 0;
    while (row < time.size() && (row == 0 ? begin : time[row - 1]) < equilibration * (1.0 - 1e-12)) ++row;
    return row;
}

/// The rows of production that have a number: active stress begins later than the others.
WatchedColumn watched(const SeriesTable& series, std::size_t first, const char* name, const char* words) {
    std::vector<double> rows = from_row(series.column(name), first);
    const auto begin = std::find_if(rows.begin(), rows.end(), [](double value) { return std::isfinite(value); });
    rows.erase(rows.begin(), begin);
    return {words, std::move(rows)};
}

/// Of the whole stress, which a flow keeps up.
std::vector<double> shear_stress(const Scene& scene, const SeriesTable& series, std::size_t first) {
    const Columns stress =
        total_stress_columns(series, first, !scene.springs.file.empty(), false, dimensions_of(scene));
    std::vector<double> rows = stress[1];
    for (std::size_t row = 0; row < rows.size(); ++row) rows[row] = 0.5 * (rows[row] + stress[3][row]);
    return rows;
}

/// What is ramped is not in equilibrium.
EquilibriumCheck by_schedule(const Scene& scene) {
    EquilibriumCheck check;
    check.verdict = Verdict::drifting;
    check.reason = fmt::format("{} until time {:.6g}", names_of_schedule(scene), schedule_end(scene));
    return check;
}

ProductionSeries production_series(const Scene& scene, const SeriesTable& series, double begin, std::size_t first,
                                   bool turn) {
    const std::vector<double>& time = series.column("time");
    ProductionSeries production;
    production.dimensions = dimensions_of(scene);
    production.row_time = time.empty() ? 0.0 : (time.back() - begin) / static_cast<double>(time.size());
    production.watched = {watched(series, first, "pressure_collision", "collision pressure")};
    if (flows(scene)) production.watched.push_back({"shear stress", shear_stress(scene, series, first)});
    if (!scene.springs.file.empty())
        production.watched.push_back(watched(series, first, "pressure_springs", "pressure of springs"));
    if (swims(scene)) production.watched.push_back(watched(series, first, "pressure_active", "active pressure"));
    if (!turn) return production;
    production.order = from_row(series.column("nematic_order"), first);
    production.order_tensor = window_columns(series, first, order_tensor_column_names);
    return production;
}

}  // namespace

bool is_ramped(const Scene& scene, const ProductionWindow& window) {
    return window.equilibration_time < schedule_end(scene) * (1.0 - 1e-12);
}

ProductionWindow production_window(const Scene& scene, const SeriesTable& series, const FreeClocks& clocks,
                                   double begin) {
    const std::vector<double>& time = series.column("time");
    ProductionWindow window;
    bool found = true;
    if (scene.time.equilibration) {
        window.equilibration_time = *scene.time.equilibration;
        window.first_row = first_row_after(time, begin, window.equilibration_time);
    } else {
        // The order may still be drifting when the pressure has settled, so the later start counts. But its own slow
        // fluctuations leave few independent samples even in equilibrium: whether it was reached, the pressure says.
        const std::size_t after_schedule = first_row_after(time, begin, schedule_end(scene));
        if (after_schedule == time.size() && after_schedule > 0)
            return {after_schedule, schedule_end(scene), by_schedule(scene)};
        const auto settled = [&](const char* name) {
            return detect_equilibration(from_row(series.column(name), after_schedule));
        };
        const Equilibration by_pressure = settled("pressure_collision"), by_order = settled("nematic_order");
        std::size_t start = std::max(by_pressure.start, by_order.start);
        if (flows(scene))
            start = std::max(start, detect_equilibration(shear_stress(scene, series, after_schedule)).start);
        window.first_row = after_schedule + start;
        window.equilibration_time = window.first_row == 0 ? begin : time[window.first_row - 1];
        found = by_pressure.reached;
    }
    if (grows(scene)) {
        window.equilibrium.reason = "the number of cells changes";
        return window;
    }
    if (compresses(scene)) {
        window.equilibrium.verdict = Verdict::drifting;
        window.equilibrium.reason = "the box is compressed; what it came to is in pressure_control";
        return window;
    }
    if (is_ramped(scene, window)) {
        window.equilibrium = by_schedule(scene);
        return window;
    }
    const bool turn = clocks.rotation > 0.0;
    window.equilibrium = check_equilibrium(production_series(scene, series, begin, window.first_row, turn), clocks);
    if (window.equilibrated() && !found) {
        window.equilibrium.verdict = Verdict::drifting;
        window.equilibrium.reason = "the collision pressure drifts, or is worth too few independent rows";
    }
    return window;
}

}  // namespace jostle
