#include "jostle/measurement/series_columns.hpp"

#include <cmath>

#include "jostle/scene/units.hpp"
#include "jostle/statistics/order_parameter.hpp"
#include "jostle/stress/orientation_stress.hpp"
#include "jostle/stress/stress.hpp"

namespace jostle {

namespace {

void append_active_columns(const Scene& scene, std::vector<SeriesColumn>& columns) {
    const std::string stress = unit_of(scene, dimension::stress);
    const std::string sign =
        "positive in compression; not a number in the rows before the first displacements of that age";
    columns.push_back({"pressure_active", stress, "Pi_act", "Tr Sigma_act/3 at this step", sign});
    for (const char* name : active_stress_column_names)
        columns.push_back({name, stress, "Sigma_act",
                           "element of the active (swim) stress at this step: sum over rods of x F over the volume, "
                           "with F = U/M_par n the force of the propulsion (0 while a rod tumbles) and x how far, "
                           "unwrapped, the rod has come in the last 1 to 2 active_stress_lag (position, force)",
                           sign});
}

void append_spring_columns(const Scene& scene, std::vector<SeriesColumn>& columns) {
    const std::string stress = unit_of(scene, dimension::stress);
    const std::string sign = "positive in compression: negative where springs pull";
    columns.push_back(
        {"pressure_springs", stress, "Pi_spr", "Tr Sigma_spr/3, mean over the steps since the last row", sign});
    for (const char* name : spring_stress_column_names)
        columns.push_back({name, stress, "Sigma_spr",
                           "element of the stress of springs (position, force), mean over the steps since the last row",
                           sign});
}

}  // namespace

void append_upper(std::vector<double>& row, const Mat3& tensor) {
    for (int a = 0; a < 3; ++a)
        for (int b = a; b < 3; ++b) row.push_back(tensor(a, b));
}

std::vector<SeriesColumn> series_columns(const Scene& scene) {
    const std::string stress = unit_of(scene, dimension::stress);
    const std::string pressure_sign = "positive in compression";
    const bool springs = !scene.springs.file.empty();
    const std::string parts = springs ? "with the kinetic part n kT and that of springs" : "with the kinetic part n kT";
    std::vector<SeriesColumn> columns = {
        {"step", "1", "k", "number of steps done", ""},
        {"time", unit_of(scene, dimension::time), "t", "simulated time", ""},
        {"N", "1", "N", "number of rods at this step", ""},
        {"phi", "1", "phi", "volume of the rods at this step over volume of the box", ""},
        {"Z", "1", "Z", "compressibility factor Pi/(n kT), mean over the steps since the last row", pressure_sign},
        {"pressure", stress, "Pi", "Tr Sigma/3 " + parts + ", mean over the steps since the last row", pressure_sign},
        {"pressure_collision", stress, "Pi_col", "Tr Sigma_col/3, mean over the steps since the last row",
         pressure_sign}};
    for (const char* name : stress_column_names)
        columns.push_back({name, stress, "Sigma_col",
                           "element of the collision stress (position, force), mean over the steps since the last row",
                           pressure_sign});
    for (const char* name : orientation_stress_column_names)
        columns.push_back({name, stress, "Sigma_ori",
                           "element of the orientation stress at this step, sum over rods of -3 kT B (n n - I/3) over "
                           "the volume, which Brownian rotation carries; symmetric, traceless",
                           pressure_sign});
    columns.push_back({"nematic_order", "1", "S", "largest eigenvalue of the order tensor at this step", ""});
    for (const char* name : order_tensor_column_names)
        columns.push_back({name, "1", "Q", "element of the order tensor <3 n n - I>/2 at this step", ""});
    const std::string length = unit_of(scene, dimension::length);
    columns.push_back(
        {"contacts", "1", "", "pairs of points that might touch, mean over the steps since the last row", ""});
    columns.push_back(
        {"active_contacts", "1", "", "contacts with a force, mean over the steps since the last row", ""});
    columns.push_back({"iterations", "1", "",
                       "sweeps over contacts, or applications of A, per step: mean over the steps since the last row",
                       ""});
    columns.push_back({"residual", length, "max |H|",
                       "residual of the contact problem, largest of the steps since the last row (the paper's norm, "
                       "without unit, if solver.residual = \"paper\")",
                       ""});
    columns.push_back({"max_overlap", length, "",
                       "largest overlap of two rods, largest of the steps since the last row", "positive: overlap"});
    if (springs) append_spring_columns(scene, columns);
    if (scene.motion.self_propulsion != 0.0) append_active_columns(scene, columns);
    if (!scene.output.stress_conventions) return columns;
    for (const char* name : centre_of_mass_column_names)
        columns.push_back({name, stress, "",
                           "element of the sum of (r_j - r_i) F over contacts, over the volume (centre of mass to "
                           "centre of mass), mean over the steps since the last row",
                           pressure_sign});
    for (const char* name : centre_line_column_names)
        columns.push_back(
            {name, stress, "",
             "element of the sum of (r_j + a_j - r_i - a_i) F over contacts, over the volume (centre line "
             "to centre line), mean over the steps since the last row",
             pressure_sign});
    return columns;
}

std::vector<double> series_row(const Simulation& simulation, const StepSums& sums) {
    const Rods& rods = simulation.rods();
    const double volume = simulation.box().volume();
    const double kT = simulation.settings().kT;
    const double density = sums.rods / sums.steps / volume;  // cells may have divided since the last row
    const Stress stress = assembly_stress(density, kT, volume,
                                          {.collision = (1.0 / sums.steps) * sums.collision_virial,
                                           .orientation = sum_of_orientation_stresses(rods, kT),
                                           .springs = (1.0 / sums.steps) * sums.spring_virial});
    const NematicOrder order = nematic_order(rods.axis);
    std::vector<double> row = {static_cast<double>(simulation.clock().step),
                               simulation.clock().time,
                               static_cast<double>(rods.size()),
                               total_volume(rods) / volume,
                               kT > 0.0 ? compressibility(stress, density, kT) : std::nan(""),
                               pressure(stress),
                               pressure_collision(stress)};
    row.insert(row.end(), stress.collision.m.begin(), stress.collision.m.end());
    append_upper(row, stress.orientation);
    row.push_back(order.order);
    append_upper(row, order.tensor);
    for (const double sum : {sums.contacts, sums.active_contacts, sums.iterations}) row.push_back(sum / sums.steps);
    row.push_back(sums.residual);
    row.push_back(sums.max_overlap);
    if (!simulation.springs().empty()) {
        row.push_back(pressure_springs(stress));
        row.insert(row.end(), stress.springs.m.begin(), stress.springs.m.end());
    }
    if (sums.active_stress) {
        row.push_back(trace(sums.active_virial) / (3.0 * volume));
        for (const double element : sums.active_virial.m) row.push_back(element / volume);
    }
    if (!simulation.settings().stress_conventions) return row;
    for (const Mat3* sum : {&sums.centre_of_mass_virial, &sums.centre_line_virial})
        for (const double element : sum->m) row.push_back(element / (sums.steps * volume));
    return row;
}

}  // namespace jostle
