#pragma once

#include <algorithm>
#include <numeric>

#include "jostle/stress/collision_moments.hpp"
#include "random_bodies.hpp"

namespace jostle::test {

/// Rods of many shapes with contacts at random points: forces and torques are those of the contacts.
struct Crowd {
    Box box{{9, 8, 7}, {true, true, false}};
    Rods rods;
    Contacts contacts;
    std::vector<double> gamma;
    std::vector<std::uint32_t> rows;
    std::vector<Vec3> torque;

    explicit Crowd(std::mt19937_64& generator, const std::array<bool, 3>& periodic = {true, true, false}) {
        box = Box(box.edges(), periodic);
        std::uniform_real_distribution<double> uniform(0.0, 1.0);
        for (std::size_t k = 0; k < 40; ++k) {
            const Vec3 centre = {9 * uniform(generator), 8 * uniform(generator), 7 * uniform(generator)};
            // Ids that are neither in order nor without gaps.
            rods.push_back(7 * ((k * 17) % 40) + 3, centre, random_direction(generator),
                           k % 5 == 0 ? 0.0 : 6.0 * uniform(generator), 0.5 + uniform(generator));
        }
        rows.resize(rods.size());
        std::iota(rows.begin(), rows.end(), 0U);
        torque.resize(rods.size());
        for (int l = 0; l < 200; ++l) {
            const auto i = static_cast<std::uint32_t>(39.0 * uniform(generator)), j = i + 1;
            const Contact contact = {i,
                                     j,
                                     random_direction(generator),
                                     (uniform(generator) - 0.5) * rods.length[i],
                                     (uniform(generator) - 0.5) * rods.length[j],
                                     0.05 * uniform(generator)};
            gamma.push_back(l % 3 == 0 ? 0.0 : uniform(generator));
            contacts.push_back(contact, {l % 2, -(l % 3), 0}, ContactFeature::nearest);
            torque[i] -= gamma.back() * cross(contact.arm_i * rods.axis[i], contact.normal);
            torque[j] += gamma.back() * cross(contact.arm_j * rods.axis[j], contact.normal);
        }
    }

    CollisionMoments moments(ContactDistance distance) const {
        return collision_moments(contacts, gamma, rods, box, rods.axis, {rows, torque}, distance);
    }
    std::vector<std::uint64_t> sorted_ids() const {
        std::vector<std::uint64_t> ids = rods.id;
        std::sort(ids.begin(), ids.end());
        return ids;
    }
};

inline Mat3 sum_of(const std::vector<Mat3>& parts) {
    Mat3 sum;
    for (const Mat3& part : parts) sum += part;
    return sum;
}

}  // namespace jostle::test
