#pragma once

#include <array>
#include <cstdint>

#include "jostle/simulation/simulation.hpp"

namespace jostle {

/// A contact as files and Python have it: by the ids of its rods, the smaller one first, or a fixed body and a rod.
struct ContactById {
    std::array<std::uint64_t, 2> id;  ///< `id_of_body`
    Image image;                      ///< of the second rod
    Vec3 normal;                      ///< from the first to the second
    std::array<double, 2> arm;
};

/// Contact l of the last step.
inline ContactById contact_by_id(const Simulation& simulation, std::size_t l) {
    const Contact& contact = simulation.contacts().contact[l];
    const Image& image = simulation.contacts().image[l];
    const std::vector<std::uint64_t>& ids = simulation.contact_ids();
    return {{id_of_body(contact.i, ids), ids[contact.j]}, image, contact.normal, {contact.arm_i, contact.arm_j}};
}

}  // namespace jostle
