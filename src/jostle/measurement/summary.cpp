#include "jostle/measurement/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "jostle/error/input_error.hpp"
#include "jostle/measurement/flow_summary.hpp"
#include "jostle/measurement/production_window.hpp"
#include "jostle/measurement/stress_columns.hpp"
#include "jostle/measurement/stress_ratio_checks.hpp"
#include "jostle/measurement/summary_entries.hpp"
#include "jostle/measurement/viscosity_at_rest.hpp"
#include "jostle/measurement/wall_columns.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/run_files/version.hpp"
#include "jostle/scene/pressure_control.hpp"
#include "jostle/scene/rod_size.hpp"
#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/schedule.hpp"
#include "jostle/scene/units.hpp"
#include "jostle/setup/free_clocks.hpp"
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
void summarise_active_stress(const SeriesTable& series, std::size_t first, const std::string& unit, Json& summary) {
    const std::vector<double>& pressure = series.column("pressure_active");
    while (first < pressure.size() && !std::isfinite(pressure[first])) ++first;
    summary["pressure_active"] = described(average(from_row(pressure, first)), unit);
    if (first >= pressure.size()) {
        summary["pressure_active"]["mean"] = nullptr;
        summary["pressure_active"]["no_standard_error_because"] =
            "The run is shorter than output.active_stress_lag: displacements are not old enough.";
        return;
    }
    summary["stress_active"] = tensor_entry(window_columns(series, first, active_stress_column_names), unit);
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
Json mean_principal_stresses(const Columns& stress, const std::string& unit, int dimensions) {
    std::array<double, 9> mean{};
    for (std::size_t k = 0; k < 9; ++k) mean[k] = column_mean(stress[k]);
    const PrincipalStresses principal = principal_stresses(stress_of(mean), dimensions);
    Json means = Json::array(), errors = Json::array();
    for (std::size_t k = 0; k < principal.values.size(); ++k) {
        means.push_back(principal.values[k]);
        errors.push_back(optional_number(average(along_rows(stress, principal.directions[k])).standard_error));
    }
    std::vector<double> difference = along_rows(stress, principal.directions.back());
    const std::vector<double> least = along_rows(stress, principal.directions.front());
    for (std::size_t row = 0; row < difference.size(); ++row) difference[row] -= least[row];
    const Average spread = average(difference);
    return {{"mean", means},
            {"standard_error", errors},
            {"unit", unit},
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

/// A constant force makes the stress along it differ from place to place; at the middle of the box it is that of its
/// mean, and as much as the moment of the force more.
Columns with_force_moment(const Scene& scene, const SeriesTable& series, std::size_t first, Columns stress) {
    if (scene.forces.on_rods == Vec3{}) return stress;
    const Columns moment = window_columns(series, first, force_moment_column_names);
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t row = 0; row < moment[k].size(); ++row) stress[4 * k][row] += moment[k][row];
    return stress;
}

bool all_alike(const Rods& rods) {
    const auto same = [](const std::vector<double>& values) {
        return std::all_of(values.begin(), values.end(), [&](double value) { return value == values.front(); });
    };
    return same(rods.length) && same(rods.diameter);
}

double mean_aspect_ratio(const Rods& rods) {
    const auto sum =
        parallel_sum<double>(rods.size(), [&](std::size_t i) { return rods.length[i] / rods.diameter[i]; });
    return sum / static_cast<double>(rods.size());
}

/// 0.3, where the volumes of rods and box give 0.3000000000000014.
double without_rounding(double value) {
    return std::stod(fmt::format("{:.12g}", value));
}

[[noreturn]] void refuse_to_average(std::string problem, std::string suggestion) {
    throw InputError({.key = "summary", .problem = std::move(problem), .suggestion = std::move(suggestion)});
}

Json box_entry(const Scene& scene, const Box& box) {
    return {{"edges", {box.edges().x, box.edges().y, box.edges().z}},  // a flat box has an edge of 0
            {"periodic", box.periodic()},
            {"unit", unit_of(scene, dimension::length)}};
}

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
std::vector<double> pressure_on_bath(const Scene& scene, const Box& box, const SeriesTable& series, std::size_t first) {
    if (!has_piston(scene)) return from_row(series.column("pressure"), first);
    for (const Wall& wall : walls_of(box)) {
        if (wall.number != 2 * static_cast<std::uint32_t>(piston_direction(scene)) + 1) continue;
        std::vector<double> pressure = from_row(series.column(force_column(wall)), first);
        for (double& value : pressure) value /= area_of(wall, box);
        return pressure;
    }
    return {};
}

/// Of a box under pressure: mean volume fraction and volume, the edges, and where the bath moves all of the box, Z = P
/// V/(N kT) and the compressibility. Without thermal motion what the last row has.
Json volume_entry(const Scene& scene, const Simulation& simulation, const SeriesTable& series, std::size_t first) {
    const double kT = simulation.settings().kT, rods = static_cast<double>(simulation.rods().size());
    const std::vector<double> volume = from_row(series.column("volume"), first);
    Json entry = {{"external", {{"value", *scene.pressure.external}, {"unit", unit_of(scene, dimension::stress)}}},
                  {"volume_fraction", described(average(from_row(series.column("phi"), first)), "")},
                  {"volume", described(average(volume), unit_of(scene, dimension::volume))}};
    if (kT > 0.0 && !has_piston(scene)) {
        std::vector<double> factor = volume;
        for (double& value : factor) value = *scene.pressure.external * value / (rods * kT);
        entry["Z"] = described(average(factor), "");
        entry["compressibility"] = compressibility_entry(volume, kT);
    }
    if (kT == 0.0)
        entry["last"] = {{"volume_fraction", series.column("phi").back()},
                         {"pressure_over_external",
                          pressure_on_bath(scene, simulation.box(), series, first).back() / *scene.pressure.external},
                         {"contacts_per_rod", 2.0 * series.column("active_contacts").back() / rods}};
    if (const auto& limit = scene.pressure.limit_volume_fraction)
        entry["limit_reached"] = series.column("phi").back() >= *limit;
    for (const char* name : edge_column_names)
        entry[name] = described(average(from_row(series.column(name), first)), unit_of(scene, dimension::length));
    return entry;
}

/// The measured pressure over that of the bath.
Json bath_check(double external, const std::vector<double>& pressure) {
    const Estimate measured =
        jackknife(Columns{pressure}, [&](std::span<const double> means) { return means[0] / external; });
    return check_of_one("pressure over that of the bath", measured);
}

/// How many there are, what they would fill if they did not overlap each other, and the mean force on all of them.
Json fixed_rods_entry(const Rods& fixed, const Box& box, const Columns& force, const std::string& unit) {
    Json means = Json::array(), errors = Json::array();
    for (const std::vector<double>& along : force) {
        const Average each = average(along);
        means.push_back(each.mean);
        errors.push_back(optional_number(each.standard_error));
    }
    return {{"count", fixed.size()},
            {"volume_fraction", without_rounding(total_volume(fixed) / box.volume())},
            {"force", {{"mean", means}, {"standard_error", errors}, {"unit", unit}}}};
}

double time_of_a_row(const SeriesTable& series, double begin) {
    return (series.column("time").back() - begin) / static_cast<double>(series.rows());
}

FreeClocks clocks_of(const Scene& scene, const Simulation& simulation) {
    return free_clocks(scene_at_end(scene), *simulation.mobility().at(simulation.rods(), simulation.box()),
                       simulation.rods());
}

/// The window of the rows so far.
ProductionWindow window_of(const Scene& scene, const Simulation& simulation, const SeriesTable& series, double begin) {
    if (simulation.rods().size() == 0) refuse_to_average("all cells have died", "");
    if (series.rows() == 0) refuse_to_average("the series has no row yet", "Make more steps");
    ProductionWindow window = production_window(scene, series, clocks_of(scene, simulation), begin);
    if (window.first_row >= series.rows())
        refuse_to_average(fmt::format("no row is of production: equilibration takes a time of {:.6g}, and it is {:.6g}",
                                      window.equilibration_time, simulation.clock().time),
                          "Make more steps");
    return window;
}

}  // namespace

Json summarise(const Scene& scene, const Simulation& simulation, const SeriesTable& series, double run_max_overlap,
               double begin) {
    const ProductionWindow window = window_of(scene, simulation, series, begin);
    const std::size_t first = window.first_row;
    const std::string stress_unit = unit_of_stress(scene);
    const Rods& rods = simulation.rods();
    const bool thermal = simulation.settings().kT > 0.0;
    const bool springs = !scene.springs.file.empty();
    const auto average_of = [&](const char* name) { return average(from_row(series.column(name), first)); };
    const Columns collision = window_columns(series, first, stress_column_names);
    const int dimensions = simulation.box().dimensions();
    const Columns stress = total_stress_columns(series, first, springs, has_torques(scene), dimensions);
    const Columns order = window_columns(series, first, order_tensor_column_names);

    Json summary;
    summary["title"] = scene.title;
    summary["L_over_D"] = mean_aspect_ratio(rods);
    summary["dimensions"] = dimensions;
    summary[dimensions == 2 ? "area_fraction" : "volume_fraction"] =
        without_rounding(total_volume(rods, dimensions) / simulation.box().volume());
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
    const Walls& walls = simulation.box().walls();
    if (thermal && simulation.box().holds_rods_alone()) summary["Z"] = described(average_of("Z"), "");
    for (const WallGroup& group : wall_groups(walls))
        summary[group.column] = described(average_of(group.column.c_str()), stress_unit);
    summary["pressure"] = described(average_of("pressure"), stress_unit);
    summary["pressure_collision"] = described(average_of("pressure_collision"), stress_unit);
    summary["stress"] = tensor_entry(stress, stress_unit);
    summary["stress"]["definition"] = fmt::format("kinetic + orientation + collision{}{}", springs ? " + springs" : "",
                                                  has_torques(scene) ? " + torques" : "");
    const bool ramped = is_ramped(scene, window);
    const double number = grows(scene) ? average_of("N").mean : static_cast<double>(rods.size());
    const double kinetic = ramped || scene.pressure.external
                               ? kinetic_pressure(series, first, springs)
                               : number / simulation.box().volume() * simulation.settings().kT;
    summary["stress_kinetic"] = {{"mean", kinetic}, {"unit", stress_unit}, {"definition", "n kT, on the diagonal"}};
    summary["stress_orientation"] = tensor_entry(orientation_stress_columns(series, first), stress_unit);
    summary["stress_collision"] = tensor_entry(collision, stress_unit);
    if (springs) {
        summary["pressure_springs"] = described(average_of("pressure_springs"), stress_unit);
        summary["stress_springs"] =
            tensor_entry(window_columns(series, first, spring_stress_column_names), stress_unit);
    }
    if (scene.pressure.external) summary["pressure_control"] = volume_entry(scene, simulation, series, first);
    if (simulation.box().fixed_rods())
        summary["fixed_rods"] = fixed_rods_entry(*simulation.box().fixed_rods(), simulation.box(),
                                                 window_columns(series, first, fixed_rod_force_column_names),
                                                 unit_of(scene, dimension::force));
    if (has_torques(scene))
        summary["stress_torques"] =
            tensor_entry(window_columns(series, first, torque_stress_column_names), stress_unit);
    if (swims(scene)) summarise_active_stress(series, first, stress_unit, summary);
    if (stirs(scene))
        for (const auto& [name, columns] : {std::pair{"stress_dipoles", dipole_stress_column_names},
                                            std::pair{"stress_thermal", thermal_stress_column_names}})
            summary[name] = tensor_entry(symmetric_columns(series, first, columns), stress_unit);
    if (flows(scene))
        summary["flow"] = flow_entry(scene, series, first, stress);
    else if (thermal)
        summary["viscosity_at_rest"] =
            viscosity_at_rest_entry(scene, simulation, window, stress, time_of_a_row(series, begin),
                                    average_of("nematic_order").mean, clocks_of(scene, simulation));
    summary["principal_stresses"] = mean_principal_stresses(stress, stress_unit, dimensions);
    summary["principal_stresses_collision"] = mean_principal_stresses(collision, stress_unit, dimensions);
    if (scene.output.stress_conventions)
        for (const auto& [name, columns] : {std::pair{"centre_of_mass", centre_of_mass_column_names},
                                            std::pair{"centre_line", centre_line_column_names}}) {
            const Columns other = window_columns(series, first, columns);
            summary["stress_conventions"][name] = tensor_entry(other, stress_unit);
            summary["stress_conventions"][name]["anisotropy"] =
                described(jackknife(other, eigenvalue_ratio_in(dimensions)));
        }
    summary["nematic_order"] = described(average_of("nematic_order"), "");
    const Vec3 director = mean_director(order).direction;
    summary["director"] = {director.x, director.y, director.z};
    summary["anisotropy"] = anisotropy(stress, summary["principal_stresses"], dimensions);
    summary["anisotropy_collision"] = anisotropy(collision, summary["principal_stresses_collision"], dimensions);
    summary["equilibration_time"] = window.equilibration_time;
    summary["equilibrated"] = window.equilibrated();
    summary["equilibrium"] = described(window.equilibrium);
    if (has_schedule(scene))
        summary["schedule"] = {
            {"keys", names_of_schedule(scene)}, {"end", schedule_end(scene)}, {"in_averages", ramped}};
    summary["production_rows"] = series.rows() - std::min(first, series.rows());
    summary["max_overlap"] = run_max_overlap / smallest_diameter(scene, rods);
    Json checks = Json::object();
    const bool in_equilibrium = simulation.keeps_equilibrium() && !springs && !ramped && !simulation.box().fixed_rods();
    if (in_equilibrium && simulation.box().is_periodic())
        checks["total_stress_ratio"] = total_stress_ratio_check(stress, order, dimensions);
    if (in_equilibrium && scene.pressure.external)
        checks["bath_pressure_ratio"] =
            bath_check(*scene.pressure.external, pressure_on_bath(scene, simulation.box(), series, first));
    for (const WallGroup& group : wall_groups(walls))
        if (in_equilibrium)
            checks[group.column + "_ratio"] =
                wall_pressure_check(group, walls, with_force_moment(scene, series, first, stress),
                                    from_row(series.column(group.column), first));
    if (in_equilibrium && all_alike(rods) && !walls.any() && !has_torques(scene))
        checks["collision_stress_ratio"] =
            collision_stress_ratio_check(collision, order, from_row(series.column("Z"), first),
                                         rods.length.front() / rods.diameter.front(), dimensions);
    const bool turns = std::any_of(rods.length.begin(), rods.length.end(), [](double length) { return length > 0.0; });
    if (flows(scene) && !oscillates(scene) && turns && thermal && !springs && !ramped) {
        checks["torque_ratio"] = torque_ratio_check(series, first);
        checks["torque_identity"] = torque_identity_check(series, first, stress_unit);
    }
    summary["checks"] = checks;
    const Average count = average_of("N");
    if (count.standard_deviation > 0.0 && !count.standard_error)
        withhold_errors(summary, "The number of cells changes throughout: averages are of no state that lasts.");
    else if (!window.equilibrated() && !grows(scene))
        withhold_errors(summary, "Equilibrium: " + in_words(window.equilibrium) + ".");
    return summary;
}

}  // namespace jostle
