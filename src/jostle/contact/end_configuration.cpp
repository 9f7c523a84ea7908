#include "jostle/contact/end_configuration.hpp"

#include <cmath>
#include <utility>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

/// What these velocities add to the known motion of a rod in a step. The farthest point is an end (rods.hpp,
/// `farthest_displacement`).
Displacement displacement_of(const ContactVelocity& velocity, const EndConfiguration::Turning& turning,
                             double time_step) {
    const auto centre = in_float(time_step * velocity.centre), axis = in_float(time_step * velocity.axis_rate);
    const float h = turning.half_length;
    const float of_centre = centre[0] * centre[0] + centre[1] * centre[1] + centre[2] * centre[2];
    const float of_axis = axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2];
    const float of_both = centre[0] * axis[0] + centre[1] * axis[1] + centre[2] * axis[2];
    // Rotations add up to second order in their angles.
    const float twist = h * std::sqrt(of_axis) * turning.by_known_motion;
    const float farthest = std::sqrt(of_centre + h * (h * of_axis + 2.0F * std::fabs(of_both))) + twist;
    const float rounding = 2e-6F * farthest;
    return {centre, {h * axis[0], h * axis[1], h * axis[2]}, farthest + rounding, twist + rounding};
}

}  // namespace

void EndConfiguration::set_velocities(const ContactMatrix& contact_matrix,
                                      std::initializer_list<std::span<const ContactVelocity>> parts) {
    local_index = contact_matrix.local_index();
    rows = contact_matrix.rods();
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
        turning[k] = {static_cast<float>(0.5 * rods.length[rows[k]]),
                      static_cast<float>(time_step * norm(known_velocity.angular[rows[k]]))};
    });
    parallel_for(rows.size(),
                 [&](std::size_t k) { displacement[k] = displacement_of(velocity[k], turning[k], time_step); });
}

void EndConfiguration::place_rods() {
    std::vector<Vec3> centres(rows.size()), axes(rows.size());
    parallel_for(rows.size(), [&](std::size_t k) {
        centres[k] = centre_at_end(rods, rows[k], known_velocity, velocity[k], time_step);
        axes[k] = axis_at_end(rods, rows[k], known_velocity, velocity[k], time_step);
    });
    placed_centre = std::move(centres);
    placed_axis = std::move(axes);
}

}  // namespace jostle
