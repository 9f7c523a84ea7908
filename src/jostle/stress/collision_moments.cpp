#include "jostle/stress/collision_moments.hpp"

namespace jostle {

CollisionMoments collision_moments(const Contacts& contacts, std::span<const double> gamma, const Rods& rods,
                                   const Box& box, std::span<const Vec3> axis, const RodTorques& torques,
                                   ContactDistance distance) {
    require_moment_rows(contacts, gamma, rods, axis, torques);
    CollisionMoments moments;
    for (std::size_t l = 0; l < contacts.size(); ++l) {
        if (gamma[l] == 0.0) continue;
        const Contact& contact = contacts.contact[l];
        const Vec3 partner = rods.centre[contact.j] + box.displacement(contacts.image[l]);
        moments.pairs.push_back({rods.id[contact.i], rods.id[contact.j], 0.5 * (rods.centre[contact.i] + partner),
                                 centre_separation(contact, rods, axis, distance), gamma[l] * contact.normal});
    }
    for (std::size_t k = 0; k < torques.rods.size(); ++k) {
        if (torques.torque[k] == Vec3{}) continue;
        const std::uint32_t row = torques.rods[k];
        moments.bodies.push_back(
            {rods.id[row], rods.centre[row],
             geometric_stress_of_rod(axis[row], rods.length[row], rods.diameter[row], torques.torque[k])});
    }
    return moments;
}

Mat3 CollisionMoments::total() const {
    Mat3 sum;
    for (const Pair& pair : pairs) sum += pair.moment();
    for (const Body& body : bodies) sum += body.geometric;
    return sum;
}

}  // namespace jostle
