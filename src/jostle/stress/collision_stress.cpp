#include "jostle/stress/collision_stress.hpp"

#include "jostle/error/refuse.hpp"
#include "jostle/parallel/sum_over_ranks.hpp"
#include "jostle/stress/spherocylinder_moments.hpp"

namespace jostle {

namespace {

void require_rows(const char* key, std::size_t rows, std::size_t needed, const char* per) {
    if (rows == needed) return;
    refuse(key, std::to_string(rows) + " rows", std::string("must have one row a ") + per,
           std::to_string(needed) + " rows");
}

/// From the contact's point on the centre line of rod i, or on the fixed body, to that on the centre line of rod j.
Vec3 between_centre_lines(const Contact& contact, const Rods& rods, ContactDistance distance) {
    const double radii = contact_radii(contact, rods);
    return (distance == ContactDistance::touching ? radii : radii + contact.gap) * contact.normal;
}

/// Sum over contacts of separation F.
template <class Separation>
Mat3 virial(const Contacts& contacts, std::span<const double> gamma, const Ranks& ranks, Separation&& separation) {
    require_rows("gamma", gamma.size(), contacts.size(), "contact");
    return sum_over_ranks<Mat3>(ranks, contacts.size(), [&](std::size_t l) {
        if (gamma[l] == 0.0) return Mat3{};
        const Contact& contact = contacts.contact[l];
        return outer(separation(contact), gamma[l] * contact.normal);
    });
}

}  // namespace

void require_moment_rows(const Contacts& contacts, std::span<const double> gamma, const Rods& rods,
                         std::span<const Vec3> axis, const RodTorques& torques) {
    require_rows("gamma", gamma.size(), contacts.size(), "contact");
    require_rows("axis", axis.size(), rods.size(), "rod");
    require_rows("torque", torques.torque.size(), torques.rods.size(), "rod");
}

Vec3 centre_separation(const Contact& contact, const Rods& rods, std::span<const Vec3> axis, ContactDistance distance) {
    const Vec3 arm_i = is_fixed(contact.i) ? Vec3{} : contact.arm_i * axis[contact.i];
    return arm_i + between_centre_lines(contact, rods, distance) - contact.arm_j * axis[contact.j];
}

Mat3 sum_of_pair_stresses(const Contacts& contacts, std::span<const double> gamma, const Rods& rods,
                          std::span<const Vec3> axis, const RodTorques& torques, ContactDistance distance) {
    return centre_of_mass_virial(contacts, gamma, rods, axis, distance) + geometric_stress(rods, axis, torques);
}

Mat3 centre_of_mass_virial(const Contacts& contacts, std::span<const double> gamma, const Rods& rods,
                           std::span<const Vec3> axis, ContactDistance distance, const Ranks& ranks) {
    require_rows("axis", axis.size(), rods.size(), "rod");
    return virial(contacts, gamma, ranks,
                  [&](const Contact& contact) { return centre_separation(contact, rods, axis, distance); });
}

Mat3 centre_line_virial(const Contacts& contacts, std::span<const double> gamma, const Rods& rods,
                        ContactDistance distance, const Ranks& ranks) {
    return virial(contacts, gamma, ranks,
                  [&](const Contact& contact) { return between_centre_lines(contact, rods, distance); });
}

Mat3 geometric_stress(const Rods& rods, std::span<const Vec3> axis, const RodTorques& torques, const Ranks& ranks) {
    require_rows("axis", axis.size(), rods.size(), "rod");
    require_rows("torque", torques.torque.size(), torques.rods.size(), "rod");
    return sum_over_ranks<Mat3>(ranks, torques.rods.size(), [&](std::size_t k) {
        const std::uint32_t row = torques.rods[k];
        return geometric_stress_of_rod(axis[row], rods.length[row], rods.diameter[row], torques.torque[k]);
    });
}

Mat3 geometric_stress_of_rod(const Vec3& axis, double length, double diameter, const Vec3& torque) {
    const Vec3 turning = cross(torque, axis);
    const double half_anisotropy = 0.5 * moment_anisotropy(length / diameter);
    const Mat3 half_spin = Mat3{{0.0, 0.5 * torque.z, -0.5 * torque.y,  //
                                 -0.5 * torque.z, 0.0, 0.5 * torque.x,  //
                                 0.5 * torque.y, -0.5 * torque.x, 0.0}};
    return half_spin + half_anisotropy * (outer(axis, turning) + outer(turning, axis));
}

}  // namespace jostle
