#include "jostle/setup/free_clocks.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>

#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/schedule.hpp"

namespace jostle {

namespace {

/// Rods that do not grow, all of one length and diameter.
bool are_alike(const Scene& scene, const Rods& rods) {
    const auto all_equal = [](std::span<const double> values) {
        return std::ranges::adjacent_find(values, std::not_equal_to{}) == values.end();
    };
    return rods.size() > 0 && !grows(scene) && all_equal(rods.length) && all_equal(rods.diameter);
}

}  // namespace

FreeClocks free_clocks(const Scene& scene, const MobilityOperator& mobility, const Rods& rods, double volume_fraction) {
    FreeClocks clocks;
    if (are_alike(scene, rods))
        clocks.slowdown = crowding_slowdown(volume_fraction, rods.length[0] / rods.diameter[0], dimensions_of(scene));
    const bool turn = std::any_of(rods.length.begin(), rods.length.end(), [](double length) { return length > 0.0; });
    const double persistence = turn ? persistence_time(scene, mobility, rods.size()) : 0.0;
    if (std::isfinite(persistence)) clocks.rotation = persistence;
    if (oscillates(scene))
        clocks.flow = 1.0 / scene.flow.frequency;
    else if (flows(scene))
        clocks.flow = 1.0 / std::fabs(scene.flow.shear_rate);
    const double kT = thermal_energy(scene);
    for (std::size_t i = 0; kT > 0.0 && i < rods.size(); ++i) {
        const RodMobility rod = mobility.of_rod(i);
        const double diffusion = translational_diffusion(kT, rod, dimensions_of(scene));
        clocks.diffusion = std::max(clocks.diffusion, rods.diameter[i] * rods.diameter[i] / diffusion);
    }
    return clocks;
}

FreeClocks free_clocks(const Scene& scene, const Simulation& simulation) {
    const Rods& rods = simulation.rods();
    const Box& box = simulation.box();
    return free_clocks(scene_at_end(scene), *simulation.mobility().at(rods, box), rods,
                       total_volume(rods, box.dimensions()) / box.volume());
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
