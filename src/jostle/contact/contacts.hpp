#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "jostle/parallel/parallel_for.hpp"
#include "jostle/rods/rods.hpp"

namespace jostle {

/// A pair of points, one on each of two rods, that may come to touch within the step.
///
///        normal: unit vector from i to j            arm: signed coordinate of the point on the rod's
///     i ===o======        gap > 0: apart                 segment, from its centre along its axis, so
///          |  gap                                        the arm vector is arm * axis
///     =====o====== j      gap < 0: overlap
struct Contact {
    std::uint32_t i = 0;  ///< the smaller row of the two rods
    std::uint32_t j = 0;  ///< the other; i == j where a rod meets its own periodic image
    Vec3 normal;
    double arm_i = 0.0;
    double arm_j = 0.0;
    double gap = 0.0;   ///< distance of the segments' points less (D_i + D_j)/2
    double room = 0.0;  ///< the gap after the known motion of the step, less that at which they touch (CollisionSearch)
};

/// Which rods meet, and in which image of j.
struct PairName {
    std::uint32_t i, j;
    Image image;

    auto operator<=>(const PairName&) const = default;
};

/// Which points a contact follows while the rods move.
enum class ContactFeature : std::uint8_t {
    nearest,   ///< the nearest points of the two segments
    end_of_i,  ///< the end of segment i at arm_i, and the point of segment j nearest to it
    end_of_j,  ///< the end of segment j at arm_j, and the point of segment i nearest to it
    pushed,    ///< the points that are nearest once contact forces have pushed the rods (pushed_overlaps.hpp)
};

/// Contacts found, in the order of (i, j, image), of a pair the nearest points first; those added within a step come
/// last: the same for any thread count and any neighbour list.
struct Contacts {
    std::vector<Contact> contact;
    std::vector<Image> image;  ///< rod j meets i displaced by image * box edges
    std::vector<ContactFeature> feature;

    std::size_t size() const { return contact.size(); }
    void clear() { resize(0); }
    void resize(std::size_t count) {
        contact.resize(count);
        image.resize(count);
        feature.resize(count);
    }
    void push_back(const Contact& new_contact, const Image& new_image, ContactFeature new_feature) {
        contact.push_back(new_contact);
        image.push_back(new_image);
        feature.push_back(new_feature);
    }

    /// Appends the contacts of part_of(0), ..., part_of(count - 1), one after the other.
    template <class PartOf>
    void append(std::size_t count, PartOf&& part_of) {
        std::vector<std::size_t> begin(count);
        std::size_t total = size();
        for (std::size_t part = 0; part < count; ++part) {
            begin[part] = total;
            total += part_of(part).size();
        }
        resize(total);
        parallel_for_parts(count, [&](std::size_t part) {
            const Contacts& from = part_of(part);
            const auto place = static_cast<std::ptrdiff_t>(begin[part]);
            std::copy(from.contact.begin(), from.contact.end(), contact.begin() + place);
            std::copy(from.image.begin(), from.image.end(), image.begin() + place);
            std::copy(from.feature.begin(), from.feature.end(), feature.begin() + place);
        });
    }
};

/// The pair that contact l belongs to.
inline PairName pair_of(const Contacts& contacts, std::size_t l) {
    return {contacts.contact[l].i, contacts.contact[l].j, contacts.image[l]};
}

}  // namespace jostle
