#include "jostle/measurement/series_columns.hpp"

#include <cmath>

#include "jostle/measurement/flow_columns.hpp"
#include "jostle/measurement/wall_columns.hpp"
#include "jostle/parallel/sum_over_ranks.hpp"
#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/scene_walls.hpp"
#include "jostle/scene/units.hpp"
#include "jostle/simulation/flow_stress.hpp"
#include "jostle/stress/orientation_stress.hpp"

namespace jostle {

namespace {

using Series = TableColumns<RowState>;

constexpr const char* in_compression = "positive in compression";

/// Over the rods of all ranks.
template <class T, class OfRod>
T sum_over_rods(const Simulation& simulation, OfRod&& of_rod) {
    const Domain& domain = simulation.domain();
    return sum_over_ranks<T>(domain.ranks(), domain.owned_of(simulation.rods().size()), of_rod);
}

/// "Tr Sigma/3"; in two dimensions "Tr Sigma/2".
std::string mean_of_normal(const Scene& scene, const char* stress) {
    return std::string("Tr ") + stress + (dimensions_of(scene) == 2 ? "/2" : "/3");
}

void add_state_columns(const Scene& scene, Series& series) {
    auto& columns = series.columns;
    columns.push_back({{"step", "1", "k", "number of steps done", ""},
                       [](const RowState& row) { return static_cast<double>(row.simulation.clock().step); }});
    columns.push_back({{"time", unit_of(scene, dimension::time), "t", "simulated time", ""},
                       [](const RowState& row) { return row.simulation.clock().time; }});
    columns.push_back({{"N", "1", "N", "number of rods at this step", ""},
                       [](const RowState& row) { return static_cast<double>(row.simulation.rods_in_all()); }});
    const char* fraction = dimensions_of(scene) == 2 ? "area of the rods at this step over area of the box"
                                                     : "volume of the rods at this step over volume of the box";
    columns.push_back(
        {{"phi", "1", "phi", fraction, ""}, [](const RowState& row) { return row.rods_volume / row.volume; }});
}

void add_pressure_columns(const Scene& scene, Series& series) {
    const std::string stress = unit_of_stress(scene);
    const bool springs = !scene.springs.file.empty();
    const std::string parts = springs ? "with the kinetic part n kT and that of springs" : "with the kinetic part n kT";
    auto& columns = series.columns;
    columns.push_back(
        {{"Z", "1", "Z", "compressibility factor Pi/(n kT), mean over the steps since the last row", in_compression},
         [](const RowState& row) {
             return row.kT > 0.0 && row.simulation.box().holds_rods_alone()
                        ? compressibility(row.stress, row.density, row.kT)
                        : std::nan("");
         }});
    columns.push_back(
        {{"pressure", stress, "Pi",
          mean_of_normal(scene, "Sigma") + " " + parts + ", mean over the steps since the last row", in_compression},
         [](const RowState& row) { return pressure(row.stress); }});
    columns.push_back(
        {{"pressure_collision", stress, "Pi_col",
          mean_of_normal(scene, "Sigma_col") + ", mean over the steps since the last row", in_compression},
         [](const RowState& row) { return pressure_collision(row.stress); }});
}

void add_stress_columns(const Scene& scene, Series& series) {
    const std::string stress = unit_of_stress(scene);
    series.add_elements(
        stress_column_names,
        {"", stress, "Sigma_col",
         "element of the collision stress (position, force), mean over the steps since the last row", in_compression},
        [](const RowState& row, std::size_t k) { return row.stress.collision.m[k]; });
    series.add_elements(orientation_stress_column_names,
                        {"", stress, "Sigma_ori",
                         dimensions_of(scene) == 2
                             ? "element of the orientation stress at this step, sum over rods of -2 kT B (n n - I/2) "
                               "over the area, which Brownian rotation carries; symmetric, traceless"
                             : "element of the orientation stress at this step, sum over rods of -3 kT B (n n - I/3) "
                               "over the volume, which Brownian rotation carries; symmetric, traceless",
                         in_compression},
                        [](const RowState& row, std::size_t k) { return upper_element(row.stress.orientation, k); });
}

void add_order_columns(const Scene& scene, Series& series) {
    series.columns.push_back({{"nematic_order", "1", "S", "largest eigenvalue of the order tensor at this step", ""},
                              [](const RowState& row) { return row.order.order; }});
    series.add_elements(order_tensor_column_names,
                        {"", "1", "Q",
                         dimensions_of(scene) == 2 ? "element of the order tensor <2 n n - I> of the plane at this step"
                                                   : "element of the order tensor <3 n n - I>/2 at this step",
                         ""},
                        [](const RowState& row, std::size_t k) { return upper_element(row.order.tensor, k); });
}

void add_contact_columns(const Scene& scene, Series& series) {
    const std::string length = unit_of(scene, dimension::length);
    auto& columns = series.columns;
    columns.push_back(
        {{"contacts", "1", "", "pairs of points that might touch, mean over the steps since the last row", ""},
         [](const RowState& row) { return row.sums.contacts / row.sums.steps; }});
    columns.push_back(
        {{"active_contacts", "1", "", "contacts with a force, mean over the steps since the last row", ""},
         [](const RowState& row) { return row.sums.active_contacts / row.sums.steps; }});
    columns.push_back(
        {{"iterations", "1", "",
          "sweeps over contacts, or applications of A, per step: mean over the steps since the last row", ""},
         [](const RowState& row) { return row.sums.iterations / row.sums.steps; }});
    columns.push_back({{"residual", length, "max |H|",
                        "residual of the contact problem, largest of the steps since the last row (the paper's norm, "
                        "without unit, if solver.residual = \"paper\")",
                        ""},
                       [](const RowState& row) { return row.sums.residual; }});
    columns.push_back({{"max_overlap", length, "",
                        "largest overlap of two rods, largest of the steps since the last row", "positive: overlap"},
                       [](const RowState& row) { return row.sums.max_overlap; }});
}

void add_spring_columns(const Scene& scene, Series& series) {
    const std::string stress = unit_of_stress(scene);
    const std::string sign = "positive in compression: negative where springs pull";
    series.columns.push_back({{"pressure_springs", stress, "Pi_spr",
                               mean_of_normal(scene, "Sigma_spr") + ", mean over the steps since the last row", sign},
                              [](const RowState& row) { return pressure_springs(row.stress); }});
    series.add_elements(
        spring_stress_column_names,
        {"", stress, "Sigma_spr",
         "element of the stress of springs (position, force), mean over the steps since the last row", sign},
        [](const RowState& row, std::size_t k) { return row.stress.springs.m[k]; });
}

void add_torque_columns(const Scene& scene, Series& series) {
    series.add_elements(torque_stress_column_names,
                        {"", unit_of_stress(scene), "Sigma_torques",
                         "element of the stress of aligning torques, the geometric part of each; traceless, mean over "
                         "the steps since the last row",
                         in_compression},
                        [](const RowState& row, std::size_t k) {
                            return row.sums.torque_virial->m[k] / (row.sums.steps * row.volume);
                        });
}

void add_force_columns(const Scene& scene, Series& series) {
    series.add_elements(force_moment_column_names,
                        {"", unit_of_stress(scene), "",
                         "sum over the rods, at this step, of the constant force times how far along it they are from "
                         "the middle of the box, over the volume: what walls feel more than the mean stress",
                         ""},
                        [force = scene.forces.on_rods](const RowState& row, std::size_t k) {
                            const auto direction = static_cast<int>(k);
                            const std::vector<Vec3>& centre = row.simulation.rods().centre;
                            const double middle = 0.5 * row.simulation.box().edges()[direction];
                            return force[direction] / row.volume *
                                   sum_over_rods<double>(row.simulation,
                                                         [&](std::size_t i) { return centre[i][direction] - middle; });
                        });
}

void add_fixed_rod_columns(const Scene& scene, Series& series) {
    series.add_elements(fixed_rod_force_column_names,
                        {"", unit_of(scene, dimension::force), "",
                         "sum of the contact forces on all fixed rods, mean over the steps since the last row",
                         "along the axis of the box"},
                        [](const RowState& row, std::size_t k) {
                            return (*row.sums.fixed_rod_force)[static_cast<int>(k)] / row.sums.steps;
                        });
}

void add_volume_columns(const Scene& scene, Series& series) {
    series.columns.push_back({{"volume", unit_of(scene, dimension::volume), "V", "volume of the box at this step", ""},
                              [](const RowState& row) { return row.volume; }});
    series.add_elements(
        edge_column_names, {"", unit_of(scene, dimension::length), "", "edge of the box at this step", ""},
        [](const RowState& row, std::size_t k) { return row.simulation.box().edges()[static_cast<int>(k)]; });
    series.columns.push_back({{"held_back", "1", "",
                               "part of the steps since the last row in which forces would have moved the box by more "
                               "than a step may; 0 of a piston",
                               ""},
                              [](const RowState& row) { return *row.sums.held_back / row.sums.steps; }});
}

void add_active_columns(const Scene& scene, Series& series) {
    const std::string stress = unit_of_stress(scene);
    const std::string sign =
        "positive in compression; not a number in the rows before the first displacements of that age";
    series.columns.push_back(
        {{"pressure_active", stress, "Pi_act", mean_of_normal(scene, "Sigma_act") + " at this step", sign},
         [](const RowState& row) {
             return trace(row.sums.active_virial) / (row.simulation.box().dimensions() * row.volume);
         }});
    series.add_elements(active_stress_column_names,
                        {"", stress, "Sigma_act",
                         "element of the active (swim) stress at this step: sum over rods of x F over the volume, "
                         "with F = U/M_par n the force of the propulsion (0 while a rod tumbles) and x how far, "
                         "unwrapped, the rod has come in the last 1 to 2 active_stress_lag (position, force)",
                         sign},
                        [](const RowState& row, std::size_t k) { return row.sums.active_virial.m[k] / row.volume; });
}

void add_stresslet_columns(const Scene& scene, Series& series) {
    const std::string stress = unit_of_stress(scene);
    series.add_elements(
        dipole_stress_column_names,
        {"", stress, "Sigma_dip",
         "element of the stress of the swimmers' force dipoles in the fluid at this step: sum over rods "
         "of p (n n - I/3) over the volume, 0 while a rod tumbles; symmetric, traceless, no part of the "
         "total",
         in_compression},
        [](const RowState& row, std::size_t k) { return upper_element(row.sums.dipole_virial, k) / row.volume; });
    series.add_elements(
        thermal_stress_column_names,
        {"", stress, "Sigma_th",
         "element of the thermal stress in the fluid at this step: sum over rods of -3 kT (n n - I/3) "
         "over the volume; symmetric, traceless, no part of the total",
         in_compression},
        [](const RowState& row, std::size_t k) { return upper_element(row.sums.thermal_virial, k) / row.volume; });
}

void add_convention_columns(const Scene& scene, Series& series) {
    const std::string stress = unit_of_stress(scene);
    const auto mean = [](const Mat3& sum, const RowState& row, std::size_t k) {
        return sum.m[k] / (row.sums.steps * row.volume);
    };
    series.add_elements(
        centre_of_mass_column_names,
        {"", stress, "",
         "element of the sum of (r_j - r_i) F over contacts, over the volume (centre of mass to "
         "centre of mass), mean over the steps since the last row",
         in_compression},
        [mean](const RowState& row, std::size_t k) { return mean(row.sums.centre_of_mass_virial, row, k); });
    series.add_elements(
        centre_line_column_names,
        {"", stress, "",
         "element of the sum of (r_j + a_j - r_i - a_i) F over contacts, over the volume (centre line "
         "to centre line), mean over the steps since the last row",
         in_compression},
        [mean](const RowState& row, std::size_t k) { return mean(row.sums.centre_line_virial, row, k); });
}

Mat3 orientation_virial(const Simulation& of) {
    const Rods& rods = of.rods();
    return sum_over_rods<Mat3>(of, [&, kT = of.settings().kT, dimensions = of.box().dimensions()](std::size_t i) {
        return orientation_stress_of_rod(rods.axis[i], rods.length[i], rods.diameter[i], kT, dimensions);
    });
}

NematicOrder order_of(const Simulation& of) {
    const std::vector<Vec3>& axis = of.rods().axis;
    const Mat3 sum = sum_over_rods<Mat3>(of, [&](std::size_t i) { return outer(axis[i], axis[i]); });
    return nematic_order(sum, of.rods_in_all(), of.box().dimensions());
}

}  // namespace

double volume_of_rods(const Simulation& of) {
    const Rods& rods = of.rods();
    return sum_over_rods<double>(of, [&, dimensions = of.box().dimensions()](std::size_t i) {
        return rod_volume(rods.length[i], rods.diameter[i], dimensions);
    });
}

RowState::RowState(const Simulation& of, const StepSums& since_last_row)
    : simulation(of),
      sums(since_last_row),
      volume(of.box().volume()),
      rods_volume(volume_of_rods(of)),
      kT(sums.kT ? *sums.kT / sums.steps : of.settings().kT),
      density(sums.rods / sums.steps / volume),
      stress(assembly_stress(density, kT, volume,
                             {.collision = (1.0 / sums.steps) * sums.collision_virial,
                              .orientation = orientation_virial(of),
                              .springs = (1.0 / sums.steps) * sums.spring_virial},
                             of.box().dimensions())),
      order(order_of(of)) {
    if (const auto& flow = of.settings().flow)
        flow_virial = sum_of_flow_stresses(of.rods(), *of.mobility().at(of.rods(), of.box()), *flow, of.clock(),
                                           of.settings().time_step, of.domain());
}

TableColumns<RowState> series_columns(const Scene& scene) {
    Series series{"series", {}};
    add_state_columns(scene, series);
    add_pressure_columns(scene, series);
    add_stress_columns(scene, series);
    add_order_columns(scene, series);
    add_contact_columns(scene, series);
    if (scene_walls(scene).any()) add_wall_columns(scene, series);
    if (has_flow(scene)) add_flow_columns(scene, series);
    if (!scene.springs.file.empty()) add_spring_columns(scene, series);
    if (scene.pressure.external) add_volume_columns(scene, series);
    if (!scene.rods.fixed.empty()) add_fixed_rod_columns(scene, series);
    if (has_torques(scene)) add_torque_columns(scene, series);
    if (scene_walls(scene).any() && scene.forces.on_rods != Vec3{}) add_force_columns(scene, series);
    if (swims(scene)) add_active_columns(scene, series);
    if (stirs(scene)) add_stresslet_columns(scene, series);
    if (scene.output.stress_conventions) add_convention_columns(scene, series);
    return series;
}

}  // namespace jostle
