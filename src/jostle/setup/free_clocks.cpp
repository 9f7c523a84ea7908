#include "jostle/setup/free_clocks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "jostle/parallel/parallel_for.hpp"
#include "jostle/scene/pressure_control.hpp"
#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/schedule.hpp"

namespace jostle {

namespace {

double mean_aspect_ratio(const Rods& rods) {
    const auto sum =
        parallel_sum<double>(rods.size(), [&](std::size_t i) { return rods.length[i] / rods.diameter[i]; });
    return sum / static_cast<double>(rods.size());
}

/// In which rods come from wall to wall: diffusing, H^2/(pi^2 D), the slowest mode of a density between planes H apart;
/// where a force drags them they sink in H/(mu f), if that is faster. `diffusion`, `mobility`: of the slowest rod.
double wall_to_wall_time(const Scene& scene, const Box& box, double diffusion, double mobility) {
    double longest = 0.0;
    for (int k = 0; k < box.dimensions(); ++k) {
        const auto direction = static_cast<std::size_t>(k);
        if (box.periodic()[direction]) continue;
        if (!scene.walls.faces[direction] && scene.walls.container == Container::none) continue;
        const double edge = box.edges()[k], speed = mobility * std::fabs(scene.forces.on_rods[k]);
        double time = INFINITY;
        if (diffusion > 0.0) time = edge * edge / (std::numbers::pi * std::numbers::pi * diffusion);
        if (speed > 0.0) time = std::min(time, edge / speed);
        if (std::isfinite(time)) longest = std::max(longest, time);
    }
    return longest;
}

}  // namespace

FreeClocks free_clocks(const Scene& scene, const MobilityOperator& mobility, const Rods& rods, const Box& box,
                       double volume_fraction) {
    FreeClocks clocks;
    if (rods.size() == 0) return clocks;
    const int dimensions = dimensions_of(scene);
    if (!grows(scene)) clocks.slowdown = crowding_slowdown(volume_fraction, mean_aspect_ratio(rods), dimensions);
    const bool turn = std::any_of(rods.length.begin(), rods.length.end(), [](double length) { return length > 0.0; });
    const double persistence = turn ? persistence_time(scene, mobility, rods.size()) : 0.0;
    if (std::isfinite(persistence)) clocks.rotation = persistence;
    clocks.axes_turn = clocks.rotation > 0.0 || (turn && swims(scene));
    if (oscillates(scene))
        clocks.flow = 1.0 / scene.flow.frequency;
    else if (flows(scene))
        clocks.flow = 1.0 / std::fabs(scene.flow.shear_rate);
    double slowest = INFINITY;  // of all rods, their translational mobility
    const double kT = thermal_energy(scene);
    for (std::size_t i = 0; i < rods.size(); ++i) {
        const double of_rod = translational_diffusion(1.0, mobility.of_rod(i), dimensions);
        slowest = std::min(slowest, of_rod);
        if (kT > 0.0)
            clocks.diffusion = std::max(clocks.diffusion, rods.diameter[i] * rods.diameter[i] / (kT * of_rod));
    }
    const double stiffness = stiffness_of_spheres(volume_fraction, dimensions), speed = scene.motion.self_propulsion;
    const double spreading = kT * slowest * stiffness + speed * speed * clocks.rotation / dimensions;
    clocks.wall_to_wall = wall_to_wall_time(scene, box, spreading, slowest);
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
                       total_volume(rods, box.dimensions()) / box.volume());
}

double stiffness_of_spheres(double volume_fraction, int dimensions) {
    const double phi = std::min(volume_fraction, 0.6), room = 1.0 - phi;
    if (dimensions == 2) return (1.0 + phi) / (room * room * room);
    return (1.0 + phi * (4.0 + phi * (4.0 + phi * (phi - 4.0)))) / (room * room * room * room);
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
