#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "jostle/contact/pair_contacts.hpp"
#include "jostle/rods/configuration.hpp"

namespace jostle {

/// How contact forces displace a rod in a step: its centre, and its ends to both sides of that; and an upper bound for
/// any point.
struct Displacement {
    std::array<float, 3> centre{}, end{};
    float farthest = 0.0F;
    float inaccuracy = 0.0F;  ///< of centre and end together, at most
};

/// Rods at the end of a step in which these contact forces act: those with contacts where the forces take them, the
/// others where the known motion does. Holds references.
struct EndConfiguration {
    const Configuration& known;                  ///< (N) after the known motion
    std::span<const std::uint32_t> local_index;  ///< (N) a rod's number among those with contacts, or no_local_index
    std::span<const std::uint32_t> rows;         ///< (n) of the rods with contacts
    const Configuration& displaced;              ///< (n) these
    std::span<const Displacement> displacement;  ///< (n) what the forces add to their known motion

    const Vec3& centre(std::uint32_t row) const {
        const std::uint32_t local = local_index[row];
        return local == no_local_index ? known.centre[row] : displaced.centre[local];
    }
    const Vec3& axis(std::uint32_t row) const {
        const std::uint32_t local = local_index[row];
        return local == no_local_index ? known.axis[row] : displaced.axis[local];
    }
    Displacement displacement_of(std::uint32_t row) const {
        const std::uint32_t local = local_index[row];
        return local == no_local_index ? Displacement{} : displacement[local];
    }

    /// The pair as `pair_geometry` gives it.
    PairGeometry pair(const Rods& rods, const Box& box, const PairKey& key) const {
        return {centre(key.j) + box.displacement(key.image) - centre(key.i),
                axis(key.i),
                axis(key.j),
                0.5 * rods.length[key.i],
                0.5 * rods.length[key.j],
                0.5 * (rods.diameter[key.i] + rods.diameter[key.j])};
    }
};

}  // namespace jostle
