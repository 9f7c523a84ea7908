#pragma once

#include <array>
#include <cstdint>

#include "jostle/simulation/simulation.hpp"

namespace jostle {

/// A contact as files and Python have it: by the ids of its rods, the smaller one first, or of its one rod twice.
struct ContactById {
    std::array<std::uint64_t, 2> id;
    int wall;            ///< number of the wall that the rod meets (rods/wall.hpp); -1: none
    std::int64_t fixed;  ///< number of the fixed rod that the rod meets; -1: none
    Image image;         ///< of the second rod
    Vec3 normal;         ///< from the first to the second, or from the wall
    std::array<double, 2> arm;
};

/// Contact l of the last step.
inline ContactById contact_by_id(const Simulation& simulation, std::size_t l) {
    const Contact& contact = simulation.contacts().contact[l];
    const Image& image = simulation.contacts().image[l];
    const std::vector<std::uint64_t>& ids = simulation.contact_ids();
    const bool alone = is_fixed(contact.i);
    return {{ids[alone ? contact.j : contact.i], ids[contact.j]},
            alone && !is_fixed_rod(contact.i) ? static_cast<int>(number_of_fixed(contact.i)) : -1,
            is_fixed_rod(contact.i) ? static_cast<std::int64_t>(number_of_fixed_rod(contact.i)) : -1,
            image,
            contact.normal,
            {contact.arm_i, contact.arm_j}};
}

}  // namespace jostle
