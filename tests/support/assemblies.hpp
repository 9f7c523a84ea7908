#pragma once

#include <random>
#include <span>
#include <vector>

#include "jostle/contact/pair_contacts.hpp"
#include "jostle/contact/segment_distance.hpp"
#include "jostle/rods/box.hpp"

namespace jostle::test {

inline Vec3 random_direction(std::mt19937_64& engine) {
    std::normal_distribution<double> normal;
    return normalised({normal(engine), normal(engine), normal(engine)});
}

/// Rods of mixed sizes thrown into a box; overlaps are left as they fall.
inline Rods thrown(std::size_t count, const Box& box, double length, double diameter, std::mt19937_64& engine) {
    std::uniform_real_distribution<double> uniform;
    Rods rods;
    for (std::size_t k = 0; k < count; ++k) {
        const Vec3 centre{uniform(engine) * box.edges().x, uniform(engine) * box.edges().y,
                          uniform(engine) * box.edges().z};
        const double scale = 0.5 + 0.5 * uniform(engine);
        const double thickness = 0.7 + 0.3 * uniform(engine);  // before the axis, whatever the compiler
        const Vec3 axis = random_direction(engine);
        rods.push_back(k, centre, axis, k % 5 == 0 ? 0.0 : scale * length, diameter * thickness);
    }
    return rods;
}

/// A pair found without any list.
struct BrutePair {
    std::size_t i, j;
    Image image;
    double gap;
};

/// Every pair (i <= j, image) with a gap below `range`, over all images that could matter.
inline std::vector<BrutePair> brute_force_pairs(const Rods& rods, const Box& box, double range) {
    std::vector<BrutePair> pairs;
    double reach = 0.0;
    for (std::size_t i = 0; i < rods.size(); ++i) reach = std::max(reach, rods.length[i] + rods.diameter[i]);
    Image most{0, 0, 0};
    for (int k = 0; k < 3; ++k) {
        const auto direction = static_cast<std::size_t>(k);
        if (box.periodic()[direction])
            most[direction] = 1 + static_cast<int>(std::ceil((reach + range) / box.edges()[k]));
    }
    most[0] += static_cast<int>(std::ceil(most[1] * std::fabs(box.offset()) / box.edges().x));
    for (std::size_t i = 0; i < rods.size(); ++i)
        for (std::size_t j = i; j < rods.size(); ++j)
            for (int x = -most[0]; x <= most[0]; ++x)
                for (int y = -most[1]; y <= most[1]; ++y)
                    for (int z = -most[2]; z <= most[2]; ++z) {
                        const Image image{x, y, z};
                        if (i == j && !(image > Image{0, 0, 0})) continue;
                        const auto points =
                            nearest_points(rods.centre[j] + box.displacement(image) - rods.centre[i], rods.axis[i],
                                           0.5 * rods.length[i], rods.axis[j], 0.5 * rods.length[j]);
                        const double gap = norm(points.separation) - 0.5 * (rods.diameter[i] + rods.diameter[j]);
                        if (gap < range) pairs.push_back({i, j, image, gap});
                    }
    return pairs;
}

/// The contacts of all pairs of different rods with a gap below `range`.
inline Contacts contacts_of_pairs(const Rods& rods, const Box& box, double range) {
    Contacts contacts;
    for (const auto& [i, j, image, gap] : brute_force_pairs(rods, box, range)) {
        if (i == j) continue;
        const PairGeometry pair = pair_geometry(rods, i, j, box.displacement(image), rods.centre, rods.axis);
        const NearestPoints nearest = nearest_points(pair);
        append_contacts({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), image}, pair, nearest,
                        norm(nearest.separation), range, 3, contacts);
    }
    return contacts;
}

/// The gap of contact `l` when the rods lie elsewhere: `centre` and `axis` replace those of `rods`.
inline double gap_at(const Contacts& contacts, std::size_t l, const Rods& rods, const Box& box,
                     std::span<const Vec3> centre, std::span<const Vec3> axis) {
    const Contact& contact = contacts.contact[l];
    const Vec3 displacement = box.displacement(contacts.image[l]);
    return gap_of_contact(contact, contacts.feature[l],
                          pair_geometry(rods, contact.i, contact.j, displacement, centre, axis));
}

}  // namespace jostle::test
