#include "jostle/measurement/production_window.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "jostle/measurement/stress_columns.hpp"
#include "jostle/measurement/summary_entries.hpp"
#include "jostle/measurement/wall_columns.hpp"
#include "jostle/scene/pressure_control.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/scene_walls.hpp"
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

/// h.Q.h, which the energy of rods in an aligning field is proportional to.
std::vector<double> order_along(const Vec3& axis, const SeriesTable& series, std::size_t first) {
    const Columns order = window_columns(series, first, order_tensor_column_names);  // xx xy xz yy yz zz
    const Vec3 h = axis / norm(axis);
    const std::array<double, 6> weights = {h.x * h.x, 2.0 * h.x * h.y, 2.0 * h.x * h.z,
                                           h.y * h.y, 2.0 * h.y * h.z, h.z * h.z};
    std::vector<double> rows(order[0].size(), 0.0);
    for (std::size_t k = 0; k < weights.size(); ++k)
        for (std::size_t row = 0; row < rows.size(); ++row) rows[row] += weights[k] * order[k][row];
    return rows;
}

/// What may not drift in equilibrium, but for the order and the active stress, from a row on.
std::vector<WatchedColumn> watched_columns(const Scene& scene, const SeriesTable& series, std::size_t first) {
    std::vector<WatchedColumn> watched;
    const auto watch = [&](const std::string& name, const std::string& words) {
        watched.push_back({words, from_row(series.column(name), first)});
    };
    watch("pressure_collision", "collision pressure");
    if (flows(scene)) watched.push_back({"shear stress", shear_stress(scene, series, first)});
    if (!scene.springs.file.empty()) watch("pressure_springs", "pressure of springs");
    if (scene.pressure.external) watch("volume", "volume");
    // Both planes of a pair together: how rods are shared between them changes slowly, below the noise of each.
    for (const WallGroup& group : wall_groups(scene_walls(scene))) watch(group.column, "pressure on " + group.in_words);
    if (has_torques(scene))
        watched.push_back({"order along the aligning axis", order_along(scene.forces.alignment_axis, series, first)});
    return watched;
}

/// The first direction along which nothing holds rods that move by themselves, or -1.
int open_direction(const Scene& scene) {
    if (!scene.springs.file.empty() || (thermal_energy(scene) == 0.0 && !swims(scene))) return -1;
    const std::array<bool, 3> periodic = box_periodic(scene), walled = walled_directions(scene);
    for (int k = 0; k < dimensions_of(scene); ++k)
        if (!periodic[static_cast<std::size_t>(k)] && !walled[static_cast<std::size_t>(k)]) return k;
    return -1;
}

ProductionSeries production_series(const Scene& scene, const SeriesTable& series, double begin, std::size_t first,
                                   bool turn) {
    const std::vector<double>& time = series.column("time");
    ProductionSeries production;
    production.dimensions = dimensions_of(scene);
    production.row_time = time.empty() ? 0.0 : (time.back() - begin) / static_cast<double>(time.size());
    production.watched = watched_columns(scene, series, first);
    if (swims(scene)) {  // begins later than the others
        std::vector<double> active = from_row(series.column("pressure_active"), first);
        std::erase_if(active, [](double value) { return !std::isfinite(value); });
        production.watched.push_back({"active pressure", std::move(active)});
    }
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
        std::size_t start = detect_equilibration(from_row(series.column("nematic_order"), after_schedule)).start;
        for (const WatchedColumn& column : watched_columns(scene, series, after_schedule)) {
            const Equilibration settled = detect_equilibration(column.rows);
            start = std::max(start, settled.start);
            if (column.name == "collision pressure") found = settled.reached;
        }
        window.first_row = after_schedule + start;
        window.equilibration_time = window.first_row == 0 ? begin : time[window.first_row - 1];
    }
    if (grows(scene)) {
        window.equilibrium.reason = "cells grow";
        return window;
    }
    if (compresses(scene)) {
        window.equilibrium.verdict = Verdict::drifting;
        window.equilibrium.reason = "the box is compressed; what it came to is in pressure_control";
        return window;
    }
    if (const int open = open_direction(scene); open >= 0) {
        window.equilibrium.verdict = Verdict::drifting;
        window.equilibrium.reason = fmt::format("the box is open along {}, where rods spread without end", "xyz"[open]);
        return window;
    }
    if (is_ramped(scene, window)) {
        window.equilibrium = by_schedule(scene);
        return window;
    }
    window.equilibrium =
        check_equilibrium(production_series(scene, series, begin, window.first_row, clocks.axes_turn), clocks);
    if (window.equilibrated() && !found) {
        window.equilibrium.verdict = Verdict::drifting;
        window.equilibrium.reason = "the collision pressure drifts, or is worth too few independent rows";
    }
    return window;
}

}  // namespace jostle
