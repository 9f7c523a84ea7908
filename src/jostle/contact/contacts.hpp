#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "jostle/parallel/parallel_for.hpp"
#include "jostle/rods/body.hpp"
#include "jostle/rods/relative_mobility.hpp"
#include "jostle/rods/rods.hpp"

namespace jostle {

/// A pair of points, one on each of two bodies, that may come to touch within the step: two rods, or a body that is
/// fixed and a rod, which is then j.
///
///        normal: unit vector from i to j            arm: signed coordinate of the point on the rod's
///     i ===o======        gap > 0: apart                 segment, from its centre along its axis, so
///          |  gap                                        the arm vector is arm * axis
///     =====o====== j      gap < 0: overlap
struct Contact {
    std::uint32_t i = 0;  ///< row of the rod with the smaller id, or a fixed body (body.hpp)
    std::uint32_t j = 0;  ///< row of the other; i == j where a rod meets its own periodic image
    Vec3 normal;
    double arm_i = 0.0;  ///< 0 of a fixed body
    double arm_j = 0.0;
    double gap = 0.0;        ///< before the step, of the points that the contact follows (theory, eq. 3.4)
    double gap_after = 0.0;  ///< the same after the known motion of the step
};

/// How far apart the points of a contact are where its bodies touch: (D_i + D_j)/2, or D_j/2 from a fixed body.
inline double contact_radii(const Contact& contact, const Rods& rods) {
    return is_fixed(contact.i) ? 0.5 * rods.diameter[contact.j]
                               : 0.5 * (rods.diameter[contact.i] + rods.diameter[contact.j]);
}

/// Which bodies meet, and in which image of j.
struct PairKey {
    std::uint32_t i, j;
    Image image;

    /// The same pair as the other rod sees it.
    PairKey turned() const { return {j, i, {-image[0], -image[1], -image[2]}}; }

    auto operator<=>(const PairKey&) const = default;
};

/// The pair with the smaller id first: what is computed of it has the same bits wherever its rods stand in memory.
inline PairKey in_order_of_ids(const PairKey& key, std::span<const std::uint64_t> ids) {
    return ids[key.i] <= ids[key.j] ? key : key.turned();
}
/// The pair with the smaller row first, as the neighbour list has it.
inline PairKey in_order_of_rows(const PairKey& key) {
    return key.i <= key.j ? key : key.turned();
}

/// Of a rod without contacts, and of a fixed body: rods that have some are numbered among themselves (ContactMatrix).
inline constexpr std::uint32_t no_local_index = 0xFFFFFFFF;

/// Which points a contact follows while the rods move.
enum class ContactFeature : std::uint8_t {
    nearest,       ///< the nearest points of the two segments
    end_of_i,      ///< the end of segment i at arm_i, and the point of segment j nearest to it
    end_of_j,      ///< the end of segment j at arm_j, and the point of segment (or fixed body) i nearest to it
    relinearised,  ///< the points that are nearest where contact forces take the rods (relinearised_contacts.hpp)
};

/// Contacts found, in the order of the pairs' rows, of a pair the nearest points first; those added within a step come
/// last: the same for any thread count and any neighbour list. Where rods stand in memory, and so the order, does not
/// matter to results.
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

    void append(const Contacts& more) {
        contact.insert(contact.end(), more.contact.begin(), more.contact.end());
        image.insert(image.end(), more.image.begin(), more.image.end());
        feature.insert(feature.end(), more.feature.begin(), more.feature.end());
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

/// The points that a contact is made of, as far apart as it found them.
inline PairOfPoints points_of(const Contact& contact, const Rods& rods) {
    return {contact.i,     contact.j,      contact.arm_i,
            contact.arm_j, contact.normal, contact.gap + contact_radii(contact, rods)};
}

/// The pair that contact l belongs to.
inline PairKey pair_of(const Contacts& contacts, std::size_t l) {
    return {contacts.contact[l].i, contacts.contact[l].j, contacts.image[l]};
}

/// The contacts in the order of their bodies' ids, of a pair in that of its images, in one as they stand; if forces are
/// given, those with a force above 0.
std::vector<std::size_t> order_of_ids(const Contacts& contacts, std::span<const std::uint64_t> ids,
                                      std::optional<std::span<const double>> gamma = std::nullopt);

}  // namespace jostle
