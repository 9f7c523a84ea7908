#include "jostle/measurement/stress_summary.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "jostle/measurement/pressure_summary.hpp"
#include "jostle/measurement/stress_columns.hpp"
#include "jostle/measurement/stress_ratio_checks.hpp"
#include "jostle/measurement/wall_columns.hpp"
#include "jostle/scene/rod_size.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/units.hpp"
#include "jostle/stress/column_names.hpp"
#include "jostle/stress/stress.hpp"

namespace jostle {

namespace {

using Json = nlohmann::ordered_json;

/// Standard errors between the largest and the smallest principal stress from which on they are called different. Those
/// of an isotropic state lie two apart in the mean, and four once in a thousand times.
constexpr double distinct = 4.0;

/// Of the means of nine columns.
auto eigenvalue_ratio_in(int dimensions) {
    return [dimensions](std::span<const double> stress) { return anisotropy_ratio(stress_of(stress), dimensions); };
}

/// The active stress, over the rows of the window that have one.
void add_active_stress(const SummarisedRun& run, Json& summary) {
    const SeriesTable& series = run.series;
    const std::string& unit = run.stress_unit;
    std::size_t first = run.first();
    const std::vector<double>& pressure = series.column("pressure_active");
    while (first < pressure.size() && !std::isfinite(pressure[first])) ++first;
    summary["pressure_active"] = described(average(from_row(pressure, first)), unit);
    if (first >= pressure.size()) {
        summary["pressure_active"]["mean"] = nullptr;
        summary["pressure_active"]["no_standard_error_because"] =
            "The run is shorter than output.active_stress_lag: displacements are not old enough.";
        return;
    }
    summary["stress_active"] = tensor_entry(window_columns(series, first, active_stress_column_names), unit,
                                            [](const auto& rows) { return average(rows); });
}

/// A stress along a fixed direction, row by row.
std::vector<double> along_rows(const Columns& stress, const Vec3& direction) {
    std::vector<double> rows(stress[0].size());
    for (std::size_t row = 0; row < rows.size(); ++row)
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b) rows[row] += direction[a] * direction[b] * stress[3 * a + b][row];
    return rows;
}

/// Eigenvalues of the mean stress, ascending, each with the error of the stress along its eigenvector.
Json mean_principal_stresses(const SummarisedRun& run, const Columns& stress) {
    std::array<double, 9> mean{};
    for (std::size_t k = 0; k < 9; ++k) mean[k] = column_mean(stress[k]);
    const PrincipalStresses principal = principal_stresses(stress_of(mean), run.dimensions());
    Json means = Json::array(), errors = Json::array();
    for (std::size_t k = 0; k < principal.values.size(); ++k) {
        means.push_back(principal.values[k]);
        errors.push_back(optional_number(run.average_of(along_rows(stress, principal.directions[k])).standard_error));
    }
    std::vector<double> difference = along_rows(stress, principal.directions.back());
    const std::vector<double> least = along_rows(stress, principal.directions.front());
    for (std::size_t row = 0; row < difference.size(); ++row) difference[row] -= least[row];
    const Average spread = run.average_of(difference);
    return {{"mean", means},
            {"standard_error", errors},
            {"unit", run.stress_unit},
            {"differ", spread.standard_error ? Json(spread.mean > distinct * *spread.standard_error) : Json(nullptr)}};
}

/// The ratio of the largest to the smallest principal stress. Where these do not differ by more than chance it has a
/// kink, and lies above 1 by noise alone: it has no error bar there.
Json anisotropy(const Columns& stress, const Json& principal, int dimensions) {
    Json entry = described(jackknife(stress, eigenvalue_ratio_in(dimensions)));
    if (principal["differ"] != Json(true))
        withhold_errors(entry, "The stress is isotropic within its error: the ratio is above 1 by chance.");
    return entry;
}

/// How many there are, what they would fill if they did not overlap each other, and the mean force on all of them.
Json fixed_rods_entry(const SummarisedRun& run) {
    const Box& box = run.simulation.box();
    const Rods& fixed = *box.fixed_rods();
    Json means = Json::array(), errors = Json::array();
    for (const std::vector<double>& along : run.columns(fixed_rod_force_column_names)) {
        const Average each = run.average_of(along);
        means.push_back(each.mean);
        errors.push_back(optional_number(each.standard_error));
    }
    return {{"count", fixed.size()},
            {"volume_fraction", without_rounding(total_volume(fixed) / box.volume())},
            {"force", {{"mean", means}, {"standard_error", errors}, {"unit", unit_of(run.scene, dimension::force)}}}};
}

void add_kinetic_stress(const SummarisedRun& run, Json& summary) {
    const Simulation& simulation = run.simulation;
    const double number = grows(run.scene) ? run.average_of("N").mean : static_cast<double>(simulation.rods().size());
    const double kinetic = run.ramped || run.scene.pressure.external
                               ? kinetic_pressure(run.series, run.first(), run.has_springs())
                               : number / simulation.box().volume() * simulation.settings().kT;
    summary["stress_kinetic"] = {{"mean", kinetic}, {"unit", run.stress_unit}, {"definition", "n kT, on the diagonal"}};
}

/// Those that only some scenes have.
void add_stresses_of_what_acts(const SummarisedRun& run, Json& summary) {
    const std::string& unit = run.stress_unit;
    if (run.has_springs()) {
        summary["pressure_springs"] = described(run.average_of("pressure_springs"), unit);
        summary["stress_springs"] = run.stress_entry(run.columns(spring_stress_column_names));
    }
    if (run.scene.pressure.external) summary["pressure_control"] = pressure_control_entry(run);
    if (run.simulation.box().fixed_rods()) summary["fixed_rods"] = fixed_rods_entry(run);
    if (has_torques(run.scene)) summary["stress_torques"] = run.stress_entry(run.columns(torque_stress_column_names));
    if (swims(run.scene)) add_active_stress(run, summary);
    if (stirs(run.scene))
        for (const auto& [name, columns] : {std::pair{"stress_dipoles", dipole_stress_column_names},
                                            std::pair{"stress_thermal", thermal_stress_column_names}})
            summary[name] = run.stress_entry(symmetric_columns(run.series, run.first(), columns));
}

void add_conventions(const SummarisedRun& run, Json& summary) {
    for (const auto& [name, columns] : {std::pair{"centre_of_mass", centre_of_mass_column_names},
                                        std::pair{"centre_line", centre_line_column_names}}) {
        const Columns other = run.columns(columns);
        summary["stress_conventions"][name] = run.stress_entry(other);
        summary["stress_conventions"][name]["anisotropy"] =
            described(jackknife(other, eigenvalue_ratio_in(run.dimensions())));
    }
}

}  // namespace

void add_stresses(const SummarisedRun& run, Json& summary) {
    const std::string& unit = run.stress_unit;
    const Box& box = run.simulation.box();
    if (run.is_thermal() && box.holds_rods_alone()) summary["Z"] = described(run.average_of("Z"), "");
    for (const WallGroup& group : wall_groups(box.walls()))
        summary[group.column] = described(run.average_of(group.column), unit);
    summary["pressure"] = described(run.average_of("pressure"), unit);
    summary["pressure_collision"] = described(run.average_of("pressure_collision"), unit);
    summary["stress"] = run.stress_entry(run.stress);
    summary["stress"]["definition"] =
        fmt::format("kinetic + orientation + collision{}{}", run.has_springs() ? " + springs" : "",
                    has_torques(run.scene) ? " + torques" : "");
    add_kinetic_stress(run, summary);
    summary["stress_orientation"] = run.stress_entry(orientation_stress_columns(run.series, run.first()));
    summary["stress_collision"] = run.stress_entry(run.collision);
    add_stresses_of_what_acts(run, summary);
}

void add_principal_stresses(const SummarisedRun& run, Json& summary) {
    const int dimensions = run.dimensions();
    summary["principal_stresses"] = mean_principal_stresses(run, run.stress);
    summary["principal_stresses_collision"] = mean_principal_stresses(run, run.collision);
    if (run.scene.output.stress_conventions) add_conventions(run, summary);
    summary["nematic_order"] = described(run.average_of("nematic_order"), "");
    const Vec3 director = mean_director(run.order).direction;
    summary["director"] = {director.x, director.y, director.z};
    summary["anisotropy"] = anisotropy(run.stress, summary["principal_stresses"], dimensions);
    summary["anisotropy_collision"] = anisotropy(run.collision, summary["principal_stresses_collision"], dimensions);
}

}  // namespace jostle
