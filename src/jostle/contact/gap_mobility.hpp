#pragma once

#include "jostle/contact/contacts.hpp"
#include "jostle/rods/rod_mobility.hpp"

namespace jostle {

/// normal.(velocity of the rod's point at `arm`) for a unit force along `normal` at that point.
inline double point_mobility(const MobileRod& rod, const Vec3& normal, double arm) {
    const double along = dot(normal, rod.axis);
    const double across_squared = squared_norm(normal) - along * along;
    const RodMobility& m = rod.mobility;
    return m.parallel * along * along + (m.perpendicular + arm * arm * m.rotational) * across_squared;
}

/// (D^T M D)_ll of a contact between these two rods, if M does not couple them: how fast a unit force on the contact
/// alone opens its gap.
inline double gap_mobility(const Contact& contact, const MobileRod& i, const MobileRod& j) {
    if (contact.i == contact.j) {  // own image: the centre stays, only turning opens the gap
        const double along = dot(contact.normal, i.axis);
        const double lever = contact.arm_j - contact.arm_i;
        return lever * lever * i.mobility.rotational * (squared_norm(contact.normal) - along * along);
    }
    return point_mobility(i, contact.normal, contact.arm_i) + point_mobility(j, contact.normal, contact.arm_j);
}

}  // namespace jostle
