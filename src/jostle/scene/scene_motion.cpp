#include "jostle/scene/scene_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "jostle/motion/external_forces.hpp"
#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/scene_walls.hpp"

namespace jostle {

namespace {

/// Of the mean time between tumbles, with tumble_time = "auto": as bacteria do (Berg and Brown 1972).
constexpr double automatic_tumble_share = 0.1;
/// Persistence times after which a free swimmer has forgotten where it swam: exp(-5) = 0.7 %.
constexpr double automatic_lag = 5.0;

}  // namespace

double thermal_energy(const Scene& scene) {
    return scene.motion.brownian ? scene.fluid.kT : 0.0;
}

Swimming swimming_of(const Scene& scene) {
    const Scene::MotionTable& motion = scene.motion;
    Swimming swimming = {motion.self_propulsion, motion.self_propulsion_deviation,
                         motion.tumble_rate,     0.0,
                         motion.reversal_rate,   motion.force_dipole,
                         dimensions_of(scene)};
    if (motion.tumble_rate > 0.0)
        swimming.tumble_time = motion.tumble_time.value_or(automatic_tumble_share / motion.tumble_rate);
    return swimming;
}

std::vector<std::unique_ptr<Motion>> motions_of(const Scene& scene) {
    std::vector<std::unique_ptr<Motion>> motions;
    if (thermal_energy(scene) > 0.0)
        motions.push_back(std::make_unique<BrownianMotion>(thermal_energy(scene), dimensions_of(scene)));
    if (swims(scene)) motions.push_back(std::make_unique<SelfPropulsion>(swimming_of(scene)));
    if (const Vec3& force = scene.forces.on_rods; force != Vec3{})
        motions.push_back(std::make_unique<ForceOnRods>(force, drifts(scene)));
    if (scene.forces.alignment_energy != 0.0)
        motions.push_back(std::make_unique<AligningTorque>(scene.forces.alignment_energy, scene.forces.alignment_axis));
    return motions;
}

bool swims(const Scene& scene) {
    return scene.motion.self_propulsion != 0.0 || !scene.schedule.self_propulsion.empty();
}

bool stirs(const Scene& scene) {
    return scene.motion.force_dipole != 0.0;
}

bool has_torques(const Scene& scene) {
    return scene.forces.alignment_energy != 0.0;
}

bool drifts(const Scene& scene) {
    const std::array<bool, 3> walled = walled_directions(scene);
    bool drifts = false;
    for (std::size_t k = 0; k < 3; ++k)
        drifts = drifts || (!walled[k] && scene.forces.on_rods[static_cast<int>(k)] != 0.0);
    return drifts;
}

bool keeps_equilibrium(const Scene& scene) {
    const auto motions = motions_of(scene);
    return thermal_energy(scene) > 0.0 && !grows(scene) && !flows(scene) &&
           std::all_of(motions.begin(), motions.end(), [](const auto& motion) { return motion->keeps_equilibrium(); });
}

namespace {

/// By how much longer a rod takes to turn round across a barrier, in kT.
double slowed_by_barrier(double barrier, int dimensions) {
    if (!(barrier > 0.0)) return 1.0;
    if (dimensions == 2) {
        constexpr double hops = std::numbers::pi * std::numbers::pi / 4.0;
        const double bessel = std::cyl_bessel_i(0.0, 0.5 * barrier);
        return hops * bessel * bessel - (hops - 1.0) * std::exp(-0.5 * barrier);
    }
    return std::expm1(barrier) / (2.0 * barrier) /
           (barrier / (1.0 + barrier) * std::sqrt(barrier / std::numbers::pi) + std::exp2(-barrier - 1.0));
}

/// Of the rod that noise, slowed by a factor, and other turns turn last.
double longest_memory(const Scene& scene, const MobilityOperator& mobility, std::size_t rod_count, double slowed,
                      double turns) {
    const double angles = dimensions_of(scene) - 1;  // by which the axis may turn
    double longest = 0.0;
    for (std::size_t i = 0; i < rod_count; ++i)
        longest =
            std::max(longest, 1.0 / (angles * thermal_energy(scene) * mobility.of_rod(i).rotational / slowed + turns));
    return longest;
}

}  // namespace

double persistence_time(const Scene& scene, const MobilityOperator& mobility, std::size_t rod_count) {
    const double kT = thermal_energy(scene);
    const double slowed = kT > 0.0 ? slowed_by_barrier(scene.forces.alignment_energy / kT, dimensions_of(scene)) : 1.0;
    return longest_memory(scene, mobility, rod_count, slowed,
                          scene.motion.tumble_rate + 2.0 * scene.motion.reversal_rate);
}

double axis_memory_time(const Scene& scene, const MobilityOperator& mobility, std::size_t rod_count) {
    return longest_memory(scene, mobility, rod_count, 1.0, scene.motion.tumble_rate);
}

double active_stress_lag(const Scene& scene, const MobilityOperator& mobility, std::size_t rod_count) {
    if (scene.output.active_stress_lag) return *scene.output.active_stress_lag;
    const double persistence = persistence_time(scene, mobility, rod_count);
    return std::isfinite(persistence) ? automatic_lag * persistence : 0.1 * scene.time.production;
}

}  // namespace jostle
