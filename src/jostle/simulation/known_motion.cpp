#include "jostle/simulation/known_motion.hpp"

#include <algorithm>
#include <utility>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

void add(const Velocities& part, Velocities& sum) {
    parallel_for(sum.size(), [&](std::size_t i) {
        sum.linear[i] += part.linear[i];
        sum.angular[i] += part.angular[i];
    });
}

/// In two dimensions rods move along x and y, and turn round z: of velocities, or of forces and torques.
void keep_in_plane(const Box& box, std::vector<Vec3>& linear, std::vector<Vec3>& angular) {
    if (box.dimensions() == 3) return;
    parallel_for(linear.size(), [&](std::size_t i) {
        linear[i].z = 0.0;
        angular[i] = {0.0, 0.0, angular[i].z};
    });
}

/// M is applied once to the sum of the forces of motions and springs; stresses need the velocities that they give
/// (theory 2.7, 2.9).
void add_velocities_of_forces(const State& state, bool has_springs, const Domain& domain,
                              std::span<const std::unique_ptr<Motion>> motions, const MobilityOperator& mobility,
                              const StepContext& context, KnownMotion& known) {
    known.exerted = sum_of_forces(motions, state.rods, context).value_or(Forces{0});
    keep_in_plane(state.box, known.exerted.force, known.exerted.torque);
    known.by_forces.resize(0);
    if (known.exerted.size() == 0 && !has_springs) return;
    Forces sum = known.exerted;
    if (has_springs) {
        known.pulls = spring_pulls(state.springs, state.rods, state.box);
        Forces of_springs = spring_forces(state.springs, known.pulls, state.rods);
        if (sum.size() == 0)
            sum = std::move(of_springs);
        else
            parallel_for(sum.size(), [&](std::size_t i) {
                sum.force[i] += of_springs.force[i];
                sum.torque[i] += of_springs.torque[i];
            });
        // Springs of ghosts are not all known here.
        domain.refresh<Vec3>([&](std::uint32_t row) -> Vec3& { return sum.force[row]; });
        domain.refresh<Vec3>([&](std::uint32_t row) -> Vec3& { return sum.torque[row]; });
    }
    mobility.apply(sum, known.by_forces);
    add(known.by_forces, known.velocity);
}

/// Whether anything but noise moves rods.
bool any_drift(bool has_springs, std::span<const std::unique_ptr<Motion>> motions) {
    return has_springs || std::ranges::any_of(motions, [](const auto& motion) { return !motion->is_noise(); });
}

}  // namespace

void find_known_motion(const State& state, bool has_springs, const Domain& domain,
                       std::span<const std::unique_ptr<Motion>> motions, const MobilityOperator& mobility,
                       const StepContext& context, KnownMotion& known) {
    const Rods& rods = state.rods;
    known.velocity.resize(rods.size());
    std::vector<Vec3>&linear = known.velocity.linear, &angular = known.velocity.angular;
    parallel_for(rods.size(), [&](std::size_t i) { linear[i] = angular[i] = Vec3{}; });
    const auto add_velocities_of = [&](bool noise) {
        for (const auto& motion : motions)
            if (motion->is_noise() == noise) motion->add_velocities(known.velocity, rods, mobility, context);
    };
    add_velocities_of(false);
    const AxialStresslets stresslets = sum_of_stresslets(motions, rods, context);
    if (stresslets.of_swimmers()) mobility.add_axial_flow(stresslets, known.velocity);
    add_velocities_of_forces(state, has_springs, domain, motions, mobility, context, known);
    keep_in_plane(state.box, linear, angular);
    known.drift = any_drift(has_springs, motions) ? known.velocity : Velocities{0};
    add_velocities_of(true);
    // kT div M belongs to the noise of this M; of swimmers it is found with the flow of their dipoles, above.
    if (stresslets.any() && !stresslets.of_swimmers()) mobility.add_axial_flow(stresslets, known.velocity);
    keep_in_plane(state.box, linear, angular);

    known.end.resize(rods.size());
    known.displacement.resize(rods.size());
    std::vector<Vec3>&centre = known.end.centre, &axis = known.end.axis;
    parallel_for(rods.size(), [&](std::size_t i) {
        centre[i] = centre_after(rods.centre[i], linear[i], context.time_step);
        axis[i] = axis_after(rods.axis[i], angular[i], context.time_step);
        known.displacement[i] =
            farthest_displacement(centre[i] - rods.centre[i], axis[i] - rods.axis[i], 0.5 * rods.length[i]);
    });
}

}  // namespace jostle
