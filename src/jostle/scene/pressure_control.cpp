#include "jostle/scene/pressure_control.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "jostle/error/refuse.hpp"
#include "jostle/mobility/drag.hpp"
#include "jostle/scene/number_text.hpp"
#include "jostle/scene/rod_size.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/scene_walls.hpp"
#include "jostle/scene/schedule.hpp"

namespace jostle {

namespace {

/// In D, by which rods that touch are brought nearer; of noise, root mean square.
constexpr double automatic_strain = 0.01, advised_strain = 0.03, largest_strain = 0.1;
/// Of a rod's mobility: noise of a plane is common to all that touch it.
constexpr double mobility_of_piston = 0.1;
/// Viscosities over the pressure: rods in suspension resist as 100 viscosities at a volume fraction of some 0.6.
constexpr double viscosities = 100.0;

/// Of a rod of mean size alone.
double diffusion_of_a_rod(const Scene& scene) {
    const RodMobility rod = capsule_drag(scene.rods.length, scene.rods.diameter, scene.fluid.viscosity);
    return thermal_energy(scene) * (rod.parallel + 2.0 * rod.perpendicular) / 3.0;
}

}  // namespace

bool is_piston(const Scene& scene) {
    return scene.pressure.coupling == StrainCoupling::piston;
}

bool compresses(const Scene& scene) {
    return scene.pressure.external && thermal_energy(scene) == 0.0;
}

int piston_direction(const Scene& scene) {
    for (int k = 0; k < 3; ++k)
        if (scene.walls.faces[static_cast<std::size_t>(k)]) return k;
    return 2;
}

double pressure_relaxation_time(const Scene& scene, double count, double edge) {
    if (scene.pressure.relaxation_time) return *scene.pressure.relaxation_time;
    if (thermal_energy(scene) == 0.0) return viscosities * scene.fluid.viscosity / *scene.pressure.external;
    const double size = scene.rods.length + scene.rods.diameter;
    return is_piston(scene) ? edge * edge / (count * mobility_of_piston * diffusion_of_a_rod(scene))
                            : size * size / diffusion_of_a_rod(scene);
}

namespace {

/// By how much the box moves where it brings rods that touch, end to end, nearer by a diameter: of the logarithm of the
/// volume, or of each edge; of a piston a length.
double move_of_a_diameter(const Scene& scene, const Rods& rods) {
    double slenderest = 0.0, thinnest = INFINITY;
    for (std::size_t i = 0; i < rods.size(); ++i) {
        slenderest = std::max(slenderest, (rods.length[i] + rods.diameter[i]) / rods.diameter[i]);
        thinnest = std::min(thinnest, rods.diameter[i]);
    }
    if (is_piston(scene)) return thinnest;
    return scene.pressure.coupling == StrainCoupling::orthogonal ? 1.0 / slenderest : 3.0 / slenderest;
}

}  // namespace

double largest_box_move(const Scene& scene, const Rods& rods) {
    return advised_strain * move_of_a_diameter(scene, rods);
}

namespace {

double count_of(const Scene& scene, const Rods& rods) {
    return static_cast<double>(rods_are_given(scene) ? rods.size() : scene.rods.count);
}

/// How far the bath moves the box in a step where rods that cannot be packed closer press as an ideal gas would; the
/// piston where nothing presses it. In equilibrium contacts resist by as much, and where that is far in one step the
/// box see-saws about its volume.
StepLimit bath_limit(const Scene& scene, const Rods& rods, const StepLimit& of_noise) {
    const double volume = volume_of_all(scene, rods), edge = box_edges(scene, volume)[piston_direction(scene)];
    const double smallest = is_piston(scene) ? share_of_box(scene.walls.container) * volume_of(box_edges(scene, volume))
                                             : volume / close_packing(scene.rods.length / scene.rods.diameter, 3);
    const double count = count_of(scene, rods), gas = count * thermal_energy(scene) / smallest;
    StepLimit limit = of_noise;
    limit.harm = "lets the bath move the box so far that contacts cannot follow";
    limit.what = is_piston(scene) ? "the bath, where nothing resists, moves the piston by"
                                  : "the bath brings rods that touch nearer, at close packing and without contact "
                                    "forces, by";
    limit.rate = *scene.pressure.external / gas / pressure_relaxation_time(scene, count, edge);
    limit.diffusive = false;
    limit.automatic = advised_strain;
    return limit;
}

StepLimit noise_limit(const Scene& scene, const Rods& rods) {
    const bool thermal = thermal_energy(scene) > 0.0;
    const double count = count_of(scene, rods);
    const double edge = box_edges(scene, volume_of_all(scene, rods))[piston_direction(scene)];
    const double time = pressure_relaxation_time(scene, count, edge);
    const double scale = move_of_a_diameter(scene, rods) / (is_piston(scene) ? edge : 1.0);
    return {.key = "pressure.relaxation_time",
            .value = rounded(time),
            .harm = thermal ? "lets the box tremble so that contacts cannot follow"
                            : "closes gaps so far that contacts cannot follow",
            .what = thermal ? "the noise of the box brings rods that touch nearer, in the root mean square, by"
                            : "the box, where nothing resists, brings rods that touch nearer by",
            .unit = "D",
            .remedy = "a longer relaxation_time",
            .rate = thermal ? 2.0 / (time * count) : 1.0 / time,
            .scale = scale,
            .diffusive = thermal,
            .automatic = automatic_strain,
            .advised = advised_strain,
            .largest = largest_strain};
}

}  // namespace

std::vector<StepLimit> pressure_limits(const Scene& scene, const Rods& rods) {
    std::vector<StepLimit> limits = {noise_limit(scene, rods)};
    if (thermal_energy(scene) > 0.0) limits.push_back(bath_limit(scene, rods, limits.front()));
    return limits;
}

namespace {

/// The one pair of planes that a piston is of.
void validate_piston(const Scene& scene, const std::string& value) {
    const int planes = static_cast<int>(std::count(scene.walls.faces.begin(), scene.walls.faces.end(), true));
    if (is_piston(scene) && planes != 1)
        refuse("pressure.coupling", "\"piston\"",
               fmt::format("moves the upper one of two planes, and there are {} pairs of them", planes),
               "walls.faces true in one direction", "");
    if (!is_piston(scene) && scene_walls(scene).any())
        refuse("pressure.external", value, "walls bear the pressure of the rods", "coupling = \"piston\"",
               "Planes across one direction can be pistons");
}

/// Without thermal motion contact forces open the box in the step in which they act, and no other force does.
void validate_compression(const Scene& scene) {
    const auto only = [&](bool there, const char* what, const char* remedy) {
        if (there)
            refuse("pressure.external", text(*scene.pressure.external),
                   fmt::format("without thermal motion compresses rods that nothing else moves, and {}", what),
                   "no [pressure]", remedy);
    };
    only(!scene.springs.file.empty(), "springs do", "Remove springs.file");
    only(scene.forces.on_rods != Vec3{} || scene.forces.alignment_energy != 0.0, "[forces] do", "Remove [forces]");
    if (scene.solver.method == SolverMethod::projected_sor && !is_piston(scene))
        refuse("solver.method", "\"projected_sor\"", "cannot solve for a box that all contacts open",
               "\"auto\", \"adaptive_bb\", \"minimum_map_newton\", \"bbpgd\", \"apgd\"", "");
    if (scene.pressure.coupling == StrainCoupling::orthogonal)
        refuse("pressure.coupling", "\"orthogonal\"",
               "needs thermal motion: of rods at rest all edges shrink in one ratio", "\"isotropic\"", "");
}

}  // namespace

void validate_pressure(const Scene& scene) {
    if (!scene.pressure.external) return;
    const std::string value = text(*scene.pressure.external);
    const auto not_with = [&](bool there, const char* what, const char* remedy) {
        if (there) refuse("pressure.external", value, what, "no [pressure]", remedy);
    };
    validate_piston(scene, value);
    const std::array<bool, 3> walled = walled_directions(scene);
    not_with(!scene.schedule.kT.empty(), "the box is moved by noise of the rods' temperature, which is to stay",
             "Remove schedule.kT");
    for (std::size_t k = 0; k < 3; ++k)
        not_with(!scene.box.periodic[k] && !walled[k], "the box is open, and nothing holds the rods",
                 "Make the box periodic along all directions but those that end at walls");
    not_with(has_flow(scene), "a flow shears the box, whose volume stays", "Keep one of the two");
    not_with(grows(scene), "cells that grow change what fills the box", "Remove [growth], or [pressure]");
    not_with(swims(scene), "the pressure of swimmers is not known from their contacts", "Remove self_propulsion");
    not_with(squeezes_box(scene), "a schedule sets the size of the box", "Keep one of the two");
    not_with(!scene.rods.fixed.empty(), "fixed rods stay where they are", "Remove rods.fixed");
    not_with(scene.mobility.model == MobilityModel::hydrodynamic, "the fluid would have to flow with the box",
             "Use mobility.model = \"capsule\"");
    not_with(scene.contact.model == ContactModel::wca, "soft rods have not been tried", "Use contact.model = \"hard\"");
    not_with(!scene.contact.brownian_correction && thermal_energy(scene) > 0.0,
             "without the time-step correction the volume would be wrong by several per cent",
             "Remove contact.brownian_correction = false");
    if (scene.pressure.coupling == StrainCoupling::orthogonal && !scene.springs.file.empty())
        refuse("pressure.coupling", "\"orthogonal\"", "springs' part of the force on each edge is not measured",
               "\"isotropic\"", "");
    const std::optional<double>&limit = scene.pressure.limit_volume_fraction, &begin = scene.box.volume_fraction;
    if (limit && begin && *limit <= *begin)
        refuse("pressure.limit_volume_fraction", text(*limit),
               fmt::format("is reached as the run begins: box.volume_fraction = {}", *begin),
               fmt::format("greater than {}", *begin), "");
    if (compresses(scene)) validate_compression(scene);
}

}  // namespace jostle
