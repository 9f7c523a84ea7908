#include "jostle/contact/end_configuration.hpp"

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

void EndConfiguration::set_velocities(const RodsWithContacts& with_contacts,
                                      std::initializer_list<std::span<const ContactVelocity>> parts) {
    with_contacts_ = with_contacts;
    velocity_.resize(rows().size());
    placed_centre_.clear();
    placed_axis_.clear();
    parallel_for(velocity_.size(), [&](std::size_t k) {
        velocity_[k] = {};
        for (const std::span<const ContactVelocity> part : parts) {
            if (k >= part.size()) continue;
            velocity_[k].centre += part[k].centre;
            velocity_[k].axis_rate += part[k].axis_rate;
        }
    });
}

void EndConfiguration::find_displacements() {
    const std::size_t known_before = turning_.size();
    turning_.resize(rows().size());
    parallel_for(turning_.size() - known_before, [&](std::size_t new_one) {
        const std::size_t k = known_before + new_one;
        turning_[k] = {0.5 * rods_.length[rows()[k]], time_step_ * norm(known_velocity_.angular[rows()[k]])};
    });
    displacement_.resize(rows().size());
    parallel_for(displacement_.size(), [&](std::size_t k) { displacement_[k] = displacement_of(k); });
}

/// What contact forces add to the known motion of a rod in the step.
Displacement EndConfiguration::displacement_of(std::size_t local) const {
    const double half_length = turning_[local].half_length;
    const Vec3 centre = time_step_ * velocity_[local].centre, axis = time_step_ * velocity_[local].axis_rate;
    // Rotations add up to second order in their angles.
    const double twist = half_length * norm(axis) * turning_[local].by_known_motion;
    const double farthest = farthest_displacement(centre, axis, half_length) + twist;
    const double rounding = 1e-6 * farthest;
    return {in_float(centre), in_float(half_length * axis), static_cast<float>(farthest + rounding),
            static_cast<float>(twist + rounding)};
}

void EndConfiguration::place_rods() {
    placed_centre_.resize(rows().size());
    placed_axis_.resize(rows().size());
    parallel_for(placed_centre_.size(), [&](std::size_t k) {
        placed_centre_[k] = displaced_centre(k);
        placed_axis_[k] = displaced_axis(k);
    });
}

}  // namespace jostle
