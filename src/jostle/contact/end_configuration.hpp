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

/// Rods at the end of a step in which these contact forces act, q + dt (U_known + U_C): those with contacts where the
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
        return rods.centre[row] + time_step * (known_velocity.linear[row] + velocity[local].centre);
    }
    Vec3 axis(std::uint32_t row) const {
        const std::uint32_t local = local_index[row];
        if (local == no_local_index) return known.axis[row];
        const Vec3& axis = rods.axis[row];
        return rotated(axis, time_step * (known_velocity.angular[row] + cross(axis, velocity[local].axis_rate)));
    }
    /// The pair as `pair_geometry` gives it.
    PairGeometry pair(const Box& box, const PairKey& key) const {
        return {centre(key.j) + box.displacement(key.image) - centre(key.i),
                axis(key.i),
                axis(key.j),
                0.5 * rods.length[key.i],
                0.5 * rods.length[key.j],
                0.5 * (rods.diameter[key.i] + rods.diameter[key.j])};
    }
};

}  // namespace jostle
