#include "jostle/measurement/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "jostle/error/input_error.hpp"
#include "jostle/measurement/flow_summary.hpp"
#include "jostle/measurement/slow_order.hpp"
#include "jostle/measurement/stress_columns.hpp"
#include "jostle/measurement/stress_summary.hpp"
#include "jostle/measurement/summary_checks.hpp"
#include "jostle/measurement/viscosity_at_rest.hpp"
#include "jostle/run_files/version.hpp"
#include "jostle/scene/rod_size.hpp"
#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/schedule.hpp"
#include "jostle/scene/units.hpp"
#include "jostle/stress/column_names.hpp"

namespace jostle {

namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse_to_average(std::string problem, std::string suggestion) {
    throw InputError({.key = "summary", .problem = std::move(problem), .suggestion = std::move(suggestion)});
}

Json box_entry(const Scene& scene, const Box& box) {
    return {{"edges", {box.edges().x, box.edges().y, box.edges().z}},  // a flat box has an edge of 0
            {"periodic", box.periodic()},
            {"unit", unit_of(scene, dimension::length)}};
}

/// The window of the rows so far.
ProductionWindow window_of(const Scene& scene, const Simulation& simulation, const SeriesTable& series,
                           const FreeClocks& clocks, double begin) {
    ProductionWindow window = production_window(scene, series, clocks, begin);
    if (window.first_row >= series.rows())
        refuse_to_average(fmt::format("no row is of production: equilibration takes a time of {:.6g}, and it is {:.6g}",
                                      window.equilibration_time, simulation.clock().time),
                          "Make more steps");
    return window;
}

/// The time of a row; the first one begins at `begin`.
double row_time(const SeriesTable& series, double begin) {
    return (series.column("time").back() - begin) / static_cast<double>(series.rows());
}

SummarisedRun summarised(const Scene& scene, const Simulation& simulation, const SeriesTable& series, double begin) {
    if (simulation.rods().size() == 0) refuse_to_average("all cells have died", "");
    if (series.rows() == 0) refuse_to_average("the series has no row yet", "Make more steps");
    const FreeClocks clocks = free_clocks(scene, simulation);
    const ProductionWindow window = window_of(scene, simulation, series, clocks, begin);
    const std::size_t first = window.first_row;
    return {.scene = scene,
            .simulation = simulation,
            .series = series,
            .begin = begin,
            .clocks = clocks,
            .window = window,
            .ramped = is_ramped(scene, window),
            .stress_unit = unit_of_stress(scene),
            .stress = total_stress_columns(series, first, !scene.springs.file.empty(), has_torques(scene),
                                           simulation.box().dimensions()),
            .collision = window_columns(series, first, stress_column_names),
            .order = window_columns(series, first, order_tensor_column_names),
            .slow_order = slow_order(window, series, row_time(series, begin), simulation.box().dimensions())};
}

/// What was simulated, and for how long.
void add_header(const SummarisedRun& run, Json& summary) {
    const Scene& scene = run.scene;
    const Simulation& simulation = run.simulation;
    const Rods& rods = simulation.rods();
    summary["title"] = scene.title;
    summary["L_over_D"] = mean_aspect_ratio(rods);
    summary["dimensions"] = run.dimensions();
    summary[run.dimensions() == 2 ? "area_fraction" : "volume_fraction"] =
        without_rounding(total_volume(rods, run.dimensions()) / simulation.box().volume());
    summary["rods"] = rods.size();
    summary["seed"] = simulation.settings().seed;
    const double speed = scene_at(scene, simulation.clock().time).motion.self_propulsion;
    summary["self_propulsion"] = {{"mean", speed}, {"unit", unit_of(scene, dimension::speed)}};
    summary["box"] = box_entry(scene, simulation.box());
    summary["version"] = program_version;
    summary["git"] = program_commit;
    summary["steps"] = simulation.clock().step;
    summary["time"] = simulation.clock().time;
    summary["time_step"] = simulation.settings().time_step;
}

void add_flow(const SummarisedRun& run, Json& summary) {
    if (flows(run.scene)) {
        summary["flow"] = flow_entry(run.scene, run.series, run.first(), run.stress);
    } else if (run.is_thermal()) {
        summary["viscosity_at_rest"] =
            viscosity_at_rest_entry(run.scene, run.simulation, run.window, run.stress, row_time(run.series, run.begin),
                                    run.average_of("nematic_order").mean, run.clocks);
    }
}

/// What was averaged over.
void add_window(const SummarisedRun& run, Json& summary) {
    summary["equilibration_time"] = run.window.equilibration_time;
    summary["equilibrated"] = run.window.equilibrated();
    summary["equilibrium"] = described(run.window.equilibrium);
    if (has_schedule(run.scene))
        summary["schedule"] = {
            {"keys", names_of_schedule(run.scene)}, {"end", schedule_end(run.scene)}, {"in_averages", run.ramped}};
    summary["production_rows"] = run.production_rows();
}

/// Whether a column fluctuates, and in too few independent rows for an error bar.
bool lacks_error(const SummarisedRun& run, const char* name) {
    const Average found = run.average_of(name);
    return found.standard_deviation > 0.0 && !found.standard_error;
}

/// The stress of springs is a part of these: where it has no error bar, theirs knows nothing of it.
void withhold_errors_of_slow_springs(const SummarisedRun& run, Json& summary) {
    if (!run.has_springs() || !lacks_error(run, "pressure_springs")) return;
    for (const char* name : {"Z", "pressure", "stress", "principal_stresses", "anisotropy"})
        if (summary.contains(name))
            withhold_errors(summary[name], "The pressure of springs, a part of it, has no error bar.");
}

/// Error bars of what does not last are none.
void withhold_errors_of_no_state(const SummarisedRun& run, Json& summary) {
    if (grows(run.scene) && (lacks_error(run, "N") || lacks_error(run, "phi")))
        withhold_errors(summary, "Cells grow throughout: averages are of no state that lasts.");
    else if (!run.window.equilibrated() && !grows(run.scene))
        withhold_errors(summary, "Equilibrium: " + in_words(run.window.equilibrium) + ".");
}

}  // namespace

Json summarise(const Scene& scene, const Simulation& simulation, const SeriesTable& series, double run_max_overlap,
               double begin) {
    const SummarisedRun run = summarised(scene, simulation, series, begin);
    Json summary;
    add_header(run, summary);
    add_stresses(run, summary);
    add_flow(run, summary);
    add_principal_stresses(run, summary);
    add_window(run, summary);
    summary["max_overlap"] = run_max_overlap / smallest_diameter(scene, simulation.rods());
    summary["checks"] = summary_checks(run);
    withhold_errors_of_slow_springs(run, summary);
    withhold_errors_of_no_state(run, summary);
    return summary;
}

Average average_in_window(const Scene& scene, const Simulation& simulation, const SeriesTable& series,
                          std::span<const double> rows, double begin) {
    const SummarisedRun run = summarised(scene, simulation, series, begin);
    if (rows.size() != run.production_rows())
        throw InputError({.key = "rows",
                          .value = fmt::format("{}", rows.size()),
                          .problem = "is not their number in production",
                          .allowed = fmt::format("{}", run.production_rows())});
    std::vector<double> present;
    std::optional<SlowColumn> slow = run.slow_order;
    if (slow) slow->rows.clear();
    for (std::size_t row = 0; row < rows.size(); ++row) {
        if (std::isnan(rows[row])) continue;
        present.push_back(rows[row]);
        if (slow) slow->rows.push_back(run.slow_order->rows[row]);
    }
    return slow ? average(present, *slow) : average(present);
}

}  // namespace jostle
