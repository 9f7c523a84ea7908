#pragma once

#include <cstdint>
#include <vector>

#include "jostle/rods/rods.hpp"

namespace jostle {

/// A pair of points, one on each of two rods, that may come to touch within the step.
///
///        normal: unit vector from i to j            arm: signed coordinate of the point on the rod's
///     i ===o======        gap > 0: apart                 segment, from its centre along its axis, so
///          |  gap                                        the arm vector is arm * axis
///     =====o====== j      gap < 0: overlap
struct Contact {
    std::uint32_t i = 0;  ///< row of the rod with the smaller id
    std::uint32_t j = 0;  ///< row of the other; i == j where a rod meets its own periodic image
    Vec3 normal;
    double arm_i = 0.0;
    double arm_j = 0.0;
    double gap = 0.0;  ///< distance of the segments' points less (D_i + D_j)/2
};

/// Which points a contact follows while the rods move.
enum class ContactFeature : std::uint8_t {
    nearest,   ///< the nearest points of the two segments
    end_of_i,  ///< the end of segment i at arm_i, and the point of segment j nearest to it
    end_of_j,  ///< the end of segment j at arm_j, and the point of segment i nearest to it
};

/// All contacts of a step, in the order of (i, j, image, feature): the same for any thread count and any neighbour
/// list.
struct Contacts {
    std::vector<Contact> contact;
    std::vector<Image> image;  ///< rod j meets i displaced by image * box edges
    std::vector<ContactFeature> feature;

    std::size_t size() const { return contact.size(); }
    void clear() {
        contact.clear();
        image.clear();
        feature.clear();
    }
    void push_back(const Contact& new_contact, const Image& new_image, ContactFeature new_feature) {
        contact.push_back(new_contact);
        image.push_back(new_image);
        feature.push_back(new_feature);
    }
};

}  // namespace jostle
