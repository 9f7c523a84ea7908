#include "jostle/stress/collision_moments.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace jostle {

CollisionMoments collision_moments(const Contacts& contacts, std::span<const double> gamma, const Rods& rods,
                                   const Box& box, std::span<const Vec3> axis, const RodTorques& torques,
                                   ContactDistance distance) {
    require_moment_rows(contacts, gamma, rods, axis, torques);
    CollisionMoments moments;
    for (const std::size_t l : order_of_ids(contacts, rods.id, gamma)) {
        const Contact& contact = contacts.contact[l];
        const Vec3 separation = centre_separation(contact, rods, axis, distance);
        const Vec3 centre_j = rods.centre[contact.j] + box.displacement(contacts.image[l]);
        const Vec3 middle =
            is_fixed(contact.i) ? centre_j - 0.5 * separation : 0.5 * (rods.centre[contact.i] + centre_j);
        moments.pairs.push_back(
            {id_of_body(contact.i, rods.id), rods.id[contact.j], middle, separation, gamma[l] * contact.normal});
    }
    std::vector<std::size_t> order(torques.rods.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto id_of = [&](std::size_t k) { return rods.id[torques.rods[k]]; };
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return id_of(a) < id_of(b); });
    for (const std::size_t k : order) {
        if (torques.torque[k] == Vec3{}) continue;
        const std::uint32_t row = torques.rods[k];
        moments.bodies.push_back(
            {rods.id[row], rods.centre[row],
             geometric_stress_of_rod(axis[row], rods.length[row], rods.diameter[row], torques.torque[k])});
    }
    return moments;
}

CollisionMoments at_first_rank(const CollisionMoments& moments, const Ranks& ranks) {
    if (ranks.alone()) return moments;
    CollisionMoments all = {ranks.gather_at_first(moments.pairs), ranks.gather_at_first(moments.bodies)};
    // Contacts of the same two rods are of one rank, and stay in the order that they have there.
    std::stable_sort(all.pairs.begin(), all.pairs.end(),
                     [](const CollisionMoments::Pair& a, const CollisionMoments::Pair& b) {
                         return std::pair(a.id_i, a.id_j) < std::pair(b.id_i, b.id_j);
                     });
    std::sort(all.bodies.begin(), all.bodies.end(),
              [](const CollisionMoments::Body& a, const CollisionMoments::Body& b) { return a.id < b.id; });
    return all;
}

Mat3 CollisionMoments::total() const {
    Mat3 sum;
    for (const Pair& pair : pairs) sum += pair.moment();
    for (const Body& body : bodies) sum += body.geometric;
    return sum;
}

}  // namespace jostle
