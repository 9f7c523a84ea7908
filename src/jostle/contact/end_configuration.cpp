#include "jostle/contact/end_configuration.hpp"

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

/// What these velocities add to the known motion of a rod in a step.
Displacement displacement_of(const ContactVelocity& velocity, double half_length, const Vec3& known_angular,
                             double time_step) {
    const auto& [linear, axis_rate] = velocity;
    // Rotations add up to second order in their angles.
    const double twist = half_length * time_step * time_step * norm(axis_rate) * norm(known_angular);
    const Vec3 centre = time_step * linear, end = (time_step * half_length) * axis_rate;
    const double farthest = farthest_displacement(centre, time_step * axis_rate, half_length) + twist;
    const double rounding = 1e-6 * farthest;
    return {in_float(centre), in_float(end), static_cast<float>(farthest + rounding),
            static_cast<float>(twist + rounding)};
}

}  // namespace

void EndConfiguration::set_velocities(const ContactMatrix& contact_matrix,
                                      std::initializer_list<std::span<const ContactVelocity>> parts) {
    local_index = contact_matrix.local_index();
    rows = contact_matrix.rods();
    velocity.resize(rows.size());
    displacement.resize(rows.size());
    parallel_for(rows.size(), [&](std::size_t k) {
        velocity[k] = {};
        for (const std::span<const ContactVelocity> part : parts) {
            if (k >= part.size()) continue;
            velocity[k].centre += part[k].centre;
            velocity[k].axis_rate += part[k].axis_rate;
        }
        displacement[k] =
            displacement_of(velocity[k], 0.5 * rods.length[rows[k]], known_velocity.angular[rows[k]], time_step);
    });
}

}  // namespace jostle
