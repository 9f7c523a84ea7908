#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "jostle/contact/contact_matrix.hpp"
#include "jostle/contact/pair_contacts.hpp"
#include "jostle/math/rotation.hpp"
#include "jostle/rods/configuration.hpp"
#include "jostle/rods/velocities.hpp"

namespace jostle {

/// How contact forces displace a rod in a step: its centre, and its ends to both sides of that; and an upper bound for
/// any point.
struct Displacement {
    std::array<float, 3> centre{}, end{};
    float farthest = 0.0F;
    float inaccuracy = 0.0F;  ///< of centre and end together, at most
};

/// Centre and axis of a rod at the end of a step, q + dt (U_known + U_C), the axis by the exponential map (theory 2.4).
inline Vec3 centre_at_end(const Rods& rods, std::uint32_t row, const Velocities& known,
                          const ContactVelocity& by_contacts, double time_step) {
    return rods.centre[row] + time_step * (known.linear[row] + by_contacts.centre);
}
inline Vec3 axis_at_end(const Rods& rods, std::uint32_t row, const Velocities& known,
                        const ContactVelocity& by_contacts, double time_step) {
    const Vec3& axis = rods.axis[row];
    return rotated(axis, time_step * (known.angular[row] + cross(axis, by_contacts.axis_rate)));
}

/// Rods at the end of a step in which these contact forces act: those with contacts where the
/// forces take them, the others where the known motion does. Worked out when asked for: few are. Holds references.
struct EndConfiguration {
    const Rods& rods;                  ///< as the step begins
    const Velocities& known_velocity;  ///< (N)
    const Configuration& known;        ///< (N) after the known motion
    double time_step;
    std::span<const std::uint32_t> local_index;  ///< (N) a rod's number among those with contacts, or no_local_index
    std::span<const std::uint32_t> rows;         ///< (n) of the rods with contacts
    std::span<const ContactVelocity> velocity;   ///< (n) theirs by contact forces
    std::span<const Displacement> displacement;  ///< (n) what the forces add to their known motion

    Vec3 centre(std::uint32_t row) const {
        const std::uint32_t local = local_index[row];
        if (local == no_local_index) return known.centre[row];
        return centre_at_end(rods, row, known_velocity, velocity[local], time_step);
    }
    Vec3 axis(std::uint32_t row) const {
        const std::uint32_t local = local_index[row];
        if (local == no_local_index) return known.axis[row];
        return axis_at_end(rods, row, known_velocity, velocity[local], time_step);
    }
    /// The pair of rods as it is there.
    PairGeometry pair(const Box& box, const PairKey& key) const {
        const Vec3 between = centre(key.j) + box.displacement(key.image) - centre(key.i);
        return pair_geometry(rods, key.i, key.j, between, axis(key.i), axis(key.j));
    }
};

}  // namespace jostle
