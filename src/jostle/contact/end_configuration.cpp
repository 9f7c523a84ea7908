#include "jostle/contact/end_configuration.hpp"

#include <utility>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

/// What these velocities add to the known motion of a rod in a step.
Displacement displacement_of(const ContactVelocity& velocity, const EndConfiguration::Turning& turning,
                             double time_step) {
    const double half_length = turning.half_length;
    const Vec3 centre = time_step * velocity.centre, axis = time_step * velocity.axis_rate;
    // Rotations add up to second order in their angles.
    const double twist = half_length * norm(axis) * turning.by_known_motion;
    const double farthest = farthest_displacement(centre, axis, half_length) + twist;
    const double rounding = 1e-6 * farthest;
    return {in_float(centre), in_float(half_length * axis), static_cast<float>(farthest + rounding),
            static_cast<float>(twist + rounding)};
}

}  // namespace

void EndConfiguration::set_velocities(const ContactMatrix& contact_matrix, std::span<const MobileRod> arms_of_rods,
                                      std::initializer_list<std::span<const ContactVelocity>> parts) {
    local_index = contact_matrix.local_index();
    rows = contact_matrix.rods();
    arms = arms_of_rods;
    velocity.resize(rows.size());
    placed_centre.clear();
    placed_axis.clear();
    parallel_for(rows.size(), [&](std::size_t k) {
        velocity[k] = {};
        for (const std::span<const ContactVelocity> part : parts) {
            if (k >= part.size()) continue;
            velocity[k].centre += part[k].centre;
            velocity[k].axis_rate += part[k].axis_rate;
        }
    });
}

void EndConfiguration::find_displacements() {
    displacement.resize(rows.size());
    const std::size_t known_before = turning.size();
    turning.resize(rows.size());
    parallel_for(rows.size() - known_before, [&](std::size_t new_one) {
        const std::size_t k = known_before + new_one;
        turning[k] = {0.5 * rods.length[rows[k]], time_step * norm(known_velocity.angular[rows[k]])};
    });
    parallel_for(rows.size(),
                 [&](std::size_t k) { displacement[k] = displacement_of(velocity[k], turning[k], time_step); });
}

void EndConfiguration::place_rods() {
    std::vector<Vec3> centres(rows.size()), axes(rows.size());
    parallel_for(rows.size(), [&](std::size_t k) {
        centres[k] = centre_at_end(rods, rows[k], known_velocity, velocity[k], time_step);
        axes[k] = axis_at_end(rods, rows[k], known_velocity, velocity[k], arms[k].axis, time_step);
    });
    placed_centre = std::move(centres);
    placed_axis = std::move(axes);
}

}  // namespace jostle
