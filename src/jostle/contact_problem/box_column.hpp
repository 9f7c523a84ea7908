#pragma once

#include <cstdint>
#include <optional>

#include "jostle/contact/arm_axes.hpp"
#include "jostle/contact/contacts.hpp"
#include "jostle/rods/body.hpp"
#include "jostle/rods/rods.hpp"

namespace jostle {

/// A box that contact forces open, or a plane of it that they push outwards, as one more body: A is A + m w w^T
/// (theory, eqs. 10.3a and 10.4).
struct BoxColumn {
    double mobility = 0.0;               ///< m; 0: the box stays
    std::optional<std::uint32_t> plane;  ///< body that is pushed; none: the logarithm of the volume grows

    /// Whether all contacts push it: then no two of them can be solved side by side.
    bool joins_all() const { return mobility > 0.0 && !plane; }

    /// w: by how much faster the gap of a contact that touches opens than the body moves.
    double of(const Contact& contact, const Rods& rods, const ArmAxes& axes) const {
        if (plane) return contact.i == *plane ? 1.0 : 0.0;
        if (is_fixed(contact.i)) return 0.0;
        const Vec3 arms = contact.arm_i * axes(contact.i) - contact.arm_j * axes(contact.j);
        const double touching = 0.5 * (rods.diameter[contact.i] + rods.diameter[contact.j]);  // as in the stress
        return (touching + dot(arms, contact.normal)) / 3.0;
    }
};

}  // namespace jostle
