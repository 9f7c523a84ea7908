#include "production_window.hpp"

#include <algorithm>
#include <vector>

#include "jostle/statistics/equilibration.hpp"

using namespace jostle;

ProductionWindow production_window(const Scene& scene, const SeriesTable& series) {
    const std::vector<double>& time = series.column("time");
    ProductionWindow window;
    if (scene.time.equilibration) {
        window.equilibration_time = *scene.time.equilibration;
        // Rows are means over the steps before them: the first of the window begins at the end of equilibration or
        // later.
        const auto begin_of = [&](std::size_t row) { return row == 0 ? 0.0 : time[row - 1]; };
        while (window.first_row < time.size() && begin_of(window.first_row) < window.equilibration_time * (1.0 - 1e-12))
            ++window.first_row;
        return window;
    }
    // The order may still be drifting when the pressure has settled, so the later start counts. But its own slow
    // fluctuations leave few independent samples even in equilibrium: whether it was reached, the pressure says.
    const Equilibration by_pressure = detect_equilibration(series.column("pressure_collision"));
    const Equilibration by_order = detect_equilibration(series.column("nematic_order"));
    window.first_row = std::max(by_pressure.start, by_order.start);
    window.equilibrated = by_pressure.reached;
    window.equilibration_time = window.first_row == 0 ? 0.0 : time[window.first_row - 1];
    return window;
}
