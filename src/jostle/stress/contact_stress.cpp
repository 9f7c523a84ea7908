#include "jostle/stress/contact_stress.hpp"

#include <fmt/format.h>

#include "jostle/error/refuse.hpp"

namespace jostle {

namespace {

void require_sound(const BodyContact& contact, std::size_t place, std::size_t bodies) {
    for (const std::uint32_t body : {contact.body_1, contact.body_2})
        if (body >= bodies)
            refuse(fmt::format("contacts[{}]", place), fmt::format("{}", body), "there is no such body",
                   fmt::format("rows below {}", bodies));
    for (const Vec3& vector : {contact.separation, contact.point_1, contact.point_2, contact.force})
        if (!is_finite(vector))
            refuse(fmt::format("contacts[{}]", place), fmt::format("{} {} {}", vector.x, vector.y, vector.z),
                   "is not finite", "");
}

/// Adds s^G of the net torques to the bodies; returns their sum.
Mat3 add_geometric_stress(std::span<const Mat3> second_moments, std::span<const BodyContact> contacts,
                          std::vector<Mat3>& per_body) {
    std::vector<Vec3> torque(per_body.size());
    for (const BodyContact& contact : contacts) {
        torque[contact.body_1] -= cross(contact.point_1, contact.force);
        torque[contact.body_2] += cross(contact.point_2, contact.force);
    }
    Mat3 sum;
    for (std::size_t k = 0; k < per_body.size(); ++k) {
        if (torque[k] == Vec3{}) continue;
        const Mat3 stress = geometric_stress(second_moments[k], torque[k]);
        per_body[k] += stress;
        sum += stress;
    }
    return sum;
}

}  // namespace

ContactStress contact_stress(std::span<const Mat3> second_moments, std::span<const BodyContact> contacts,
                             StressConvention convention) {
    ContactStress stress{{}, {}, std::vector<Mat3>(second_moments.size())};
    for (std::size_t l = 0; l < contacts.size(); ++l) {
        const BodyContact& contact = contacts[l];
        require_sound(contact, l, second_moments.size());
        const Vec3 between_points = contact.separation + contact.point_2 - contact.point_1;
        const Mat3 virial =
            outer(convention == StressConvention::centre_line ? between_points : contact.separation, contact.force);
        stress.virial += virial;
        stress.per_body[contact.body_1] += 0.5 * virial;
        stress.per_body[contact.body_2] += 0.5 * virial;
    }
    if (convention == StressConvention::rigid_body)
        stress.geometric = add_geometric_stress(second_moments, contacts, stress.per_body);
    return stress;
}

}  // namespace jostle
