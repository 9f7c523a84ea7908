#include "jostle/setup/free_clocks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "jostle/motion/spring_modes.hpp"
#include "jostle/scene/pressure_control.hpp"
#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/schedule.hpp"

namespace jostle {

namespace {

/// Whether a start may leave the density uneven along a periodic direction, as no random one and no lattice does. The
/// box may be roomier than that of the run whose rods begin in it.
bool may_be_uneven(const Scene& scene) {
    return scene.rods.start == StartKind::file || scene.rods.start == StartKind::run;
}

/// In which a density evens out: between planes H apart H^2/(pi^2 D), its slowest mode, in a box of period L L^2/(4
/// pi^2 D); swimmers take H/U_0 more. Where a force drags rods to a wall they sink in H/(mu f), if that is faster.
/// `diffusion`, `mobility`: of the slowest rod.
double spreading_time(const Scene& scene, const Box& box, double diffusion, double mobility) {
    const double swimming = scene.motion.self_propulsion;
    double longest = 0.0;
    for (int k = 0; k < box.dimensions(); ++k) {
        const auto direction = static_cast<std::size_t>(k);
        const bool periodic = box.periodic()[direction];
        const bool closed = scene.walls.faces[direction] || scene.walls.container != Container::none;
        if (periodic ? !may_be_uneven(scene) : !closed) continue;
        const double edge = (periodic ? 0.5 : 1.0) * box.edges()[k];
        const double speed = periodic ? 0.0 : mobility * std::fabs(scene.forces.on_rods[k]);
        double time = diffusion > 0.0 ? edge * edge / (std::numbers::pi * std::numbers::pi * diffusion) : 0.0;
        if (swimming > 0.0) time += edge / swimming;
        if (speed > 0.0) time = time > 0.0 ? std::min(time, edge / speed) : edge / speed;
        longest = std::max(longest, time);
    }
    return longest;
}

/// Of what turns rods, and swimmers, which keep their direction for `persistence`.
void set_rotation(const Scene& scene, const MobilityOperator& mobility, const Rods& rods, double persistence,
                  FreeClocks& clocks) {
    const bool turn = std::any_of(rods.length.begin(), rods.length.end(), [](double length) { return length > 0.0; });
    const double memory = axis_memory_time(scene, mobility, rods.size());
    if (turn && std::isfinite(memory)) clocks.rotation = memory;
    // Swimming rods that nothing else turns are turned by their neighbours, spheres by nothing.
    if (swims(scene) && (std::isfinite(persistence) || !turn)) clocks.rotation = std::max(clocks.rotation, persistence);
    clocks.axes_turn = turn && (clocks.rotation > 0.0 || swims(scene));
}

}  // namespace

FreeClocks free_clocks(const Scene& scene, const MobilityOperator& mobility, const Rods& rods, const Box& box,
                       double volume_fraction, std::span<const Spring> springs) {
    FreeClocks clocks;
    if (rods.size() == 0) return clocks;
    const int dimensions = dimensions_of(scene);
    const double persistence = swims(scene) ? persistence_time(scene, mobility, rods.size()) : 0.0;
    set_rotation(scene, mobility, rods, persistence, clocks);
    if (!grows(scene)) clocks.slowdown = crowding_slowdown(volume_fraction, mean_aspect_ratio(rods), dimensions);
    if (flows(scene))
        clocks.flow = oscillates(scene) ? 1.0 / scene.flow.frequency : 1.0 / std::fabs(scene.flow.shear_rate);
    const double speed = scene.motion.self_propulsion;
    const double by_swimming = std::isfinite(persistence) ? speed * speed * persistence / dimensions : 0.0;
    double slowest = INFINITY;  // of all rods, their translational mobility
    const double kT = thermal_energy(scene);
    for (std::size_t i = 0; i < rods.size(); ++i) {
        const double of_rod = translational_diffusion(1.0, mobility.of_rod(i), dimensions);
        slowest = std::min(slowest, of_rod);
        if (kT == 0.0) continue;
        clocks.diffusion = std::max(clocks.diffusion, rods.diameter[i] * rods.diameter[i] / (kT * of_rod));
        clocks.passing = std::max(clocks.passing, 0.25 * rods.length[i] * rods.length[i] / (kT * of_rod + by_swimming));
    }
    if (scene.rods.start != StartKind::lattice)  // those of a file or a run may have begun at random, too
        clocks.arrest = diffusion_arrest(volume_fraction, dimensions);
    const double stiffness = stiffness_of_spheres(volume_fraction, dimensions);
    // Rods that differ have to change places, which no pressure hastens.
    const double spreading = kT * slowest * (all_alike(rods) ? stiffness : 1.0) + by_swimming;
    clocks.spreading = spreading_time(scene, box, spreading, slowest);
    clocks.springs = slowest_spring_time(springs, mobility_by_id(rods, mobility), kT, dimensions);
    if (scene.pressure.external && kT > 0.0) {
        const double of_a_rod = total_volume(rods, dimensions) / static_cast<double>(rods.size());
        const double count = std::round(volume_fraction * box.volume() / of_a_rod);
        clocks.volume = pressure_relaxation_time(scene, count, box.edges()[piston_direction(scene)]) / stiffness;
    }
    return clocks;
}

FreeClocks free_clocks(const Scene& scene, const Simulation& simulation) {
    const Rods& rods = simulation.rods();
    const Box& box = simulation.box();
    return free_clocks(scene_at_end(scene), *simulation.mobility().at(rods, box), rods, box,
                       total_volume(rods, box.dimensions()) / box.volume(), simulation.state().springs);
}

double stiffness_of_spheres(double volume_fraction, int dimensions) {
    const double phi = std::min(volume_fraction, 0.6), room = 1.0 - phi;
    if (dimensions == 2) return (1.0 + phi) / (room * room * room);
    return (1.0 + phi * (4.0 + phi * (4.0 + phi * (phi - 4.0)))) / (room * room * room * room);
}

double diffusion_arrest(double volume_fraction, int dimensions) {
    const double arrested = dimensions == 2 ? 0.80 : 0.58;
    const double long_time = std::pow(std::max(1e-3, 1.0 - volume_fraction / arrested), 1.2);  // D_L/D_0
    constexpr double structure = 12.0 / 49.0;  // twelve times 1/(q^2 D_L), in D^2/D_L, q = 7/D
    return std::max(1.0, structure / least_diffusion_times / long_time);
}

double crowding_slowdown(double volume_fraction, double aspect_ratio, int dimensions) {
    constexpr double slowest = 100.0, spinodal = 4.0, spinodal_in_plane = 1.5 * std::numbers::pi;
    if (dimensions == 2) {
        const double area_fraction = std::min(volume_fraction, 0.9);
        const double density = area_fraction / rod_volume(aspect_ratio, 1.0, 2);
        const double crowd = density * aspect_ratio * aspect_ratio / std::pow(1.0 - area_fraction, 0.8);
        return 1.0 / std::max(0.1, std::fabs(1.0 - crowd / spinodal_in_plane));
    }
    const double phi = std::min(volume_fraction, 0.7), volume = std::numbers::pi * (aspect_ratio / 4.0 + 1.0 / 6.0);
    const double crowd = std::numbers::pi / 4.0 * (phi / volume) * aspect_ratio * aspect_ratio * (1.0 - 0.75 * phi) /
                         ((1.0 - phi) * (1.0 - phi));
    const double collective = 1.0 / std::max(0.1, std::fabs(1.0 - crowd / spinodal));
    const double neighbours = crowd < spinodal ? std::exp(8.0 * phi * phi) : 1.0;
    return std::clamp(collective * neighbours, 1.0, slowest);
}

}  // namespace jostle
