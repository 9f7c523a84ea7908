#include "jostle/measurement/pressure_summary.hpp"

#include "jostle/measurement/stress_ratio_checks.hpp"
#include "jostle/measurement/wall_columns.hpp"
#include "jostle/scene/pressure_control.hpp"
#include "jostle/scene/units.hpp"
#include "jostle/stress/column_names.hpp"

namespace jostle {

namespace {

using Json = nlohmann::ordered_json;

/// var V/(kT <V>).
Json compressibility_entry(const std::vector<double>& volume, double kT) {
    std::vector<double> squares = volume;
    const double reference = column_mean(volume);
    for (double& value : squares) value = (value - reference) * (value - reference);
    return described(jackknife(Columns{volume, squares}, [&](std::span<const double> means) {
        const double shift = means[0] - reference;
        return (means[1] - shift * shift) / (kT * means[0]);
    }));
}

bool has_piston(const Scene& scene) {
    return scene.pressure.coupling == StrainCoupling::piston;
}

/// Of the rods on the bath: on the piston, or the mean over all directions.
std::vector<double> pressure_on_bath(const SummarisedRun& run) {
    if (!has_piston(run.scene)) return run.column("pressure");
    const Box& box = run.simulation.box();
    for (const Wall& wall : walls_of(box)) {
        if (wall.number != 2 * static_cast<std::uint32_t>(piston_direction(run.scene)) + 1) continue;
        std::vector<double> pressure = run.column(force_column(wall));
        for (double& value : pressure) value /= area_of(wall, box);
        return pressure;
    }
    return {};
}

}  // namespace

Json pressure_control_entry(const SummarisedRun& run) {
    const Scene& scene = run.scene;
    const SeriesTable& series = run.series;
    const double kT = run.simulation.settings().kT, rods = static_cast<double>(run.simulation.rods().size());
    const std::vector<double> volume = run.column("volume");
    Json entry = {{"external", {{"value", *scene.pressure.external}, {"unit", unit_of(scene, dimension::stress)}}},
                  {"volume_fraction", described(run.average_of("phi"), "")},
                  {"volume", described(run.average_of(volume), unit_of(scene, dimension::volume))}};
    if (kT > 0.0 && !has_piston(scene)) {
        std::vector<double> factor = volume;
        for (double& value : factor) value = *scene.pressure.external * value / (rods * kT);
        entry["Z"] = described(run.average_of(factor), "");
        entry["compressibility"] = compressibility_entry(volume, kT);
    }
    if (kT > 0.0) entry["held_back"] = column_mean(run.column("held_back"));
    if (kT == 0.0)
        entry["last"] = {{"volume_fraction", series.column("phi").back()},
                         {"pressure_over_external", pressure_on_bath(run).back() / *scene.pressure.external},
                         {"contacts_per_rod", 2.0 * series.column("active_contacts").back() / rods}};
    if (const auto& limit = scene.pressure.limit_volume_fraction)
        entry["limit_reached"] = series.column("phi").back() >= *limit;
    for (const char* name : edge_column_names)
        entry[name] = described(run.average_of(name), unit_of(scene, dimension::length));
    return entry;
}

Json bath_pressure_check(const SummarisedRun& run) {
    const double external = *run.scene.pressure.external;
    const Estimate measured =
        jackknife(Columns{pressure_on_bath(run)}, [&](std::span<const double> means) { return means[0] / external; });
    return check_of_one("pressure over that of the bath", measured);
}

}  // namespace jostle
