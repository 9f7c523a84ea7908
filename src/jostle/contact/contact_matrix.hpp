#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "jostle/contact/contacts.hpp"
#include "jostle/rods/forces.hpp"
#include "jostle/rods/velocities.hpp"

namespace jostle {

/// The matrix D of theory, eq. (2.2): forces F_C = D gamma on the rods, gap velocities D^T U. Never formed.
///
/// Column l is (-normal, -a_i x normal; +normal, +a_j x normal) with arms a = arm * axis. As an arm is along its rod's
/// axis,
///     D^T U = normal.(U_j + arm_j W_j - U_i - arm_i W_i),  W = Omega x axis,
///     torque = axis x (sum of +- arm gamma normal),
/// so no cross product is needed per contact. Holds references: contacts and rods must outlive it and stay unchanged.
class ContactMatrix {
public:
    ContactMatrix(const Contacts& contacts, const Rods& rods);

    /// forces = D gamma; `gamma`: one force per contact, positive where the rods repel each other.
    void apply(std::span<const double> gamma, Forces& forces) const;

    /// rates = D^T velocities: the velocity at which each gap opens.
    void apply_transpose(const Velocities& velocities, std::span<double> rates) const;

    std::size_t contact_count() const { return contacts_.size(); }
    const Contacts& contacts() const { return contacts_; }
    const Rods& rods() const { return rods_; }

private:
    const Contacts& contacts_;
    const Rods& rods_;
    /// Contacts of each rod in ascending order: 2 l where the rod is i of contact l, 2 l + 1 where it is j. Each rod
    /// gathers its own forces, in this order, so that the sum does not depend on threads.
    std::vector<std::uint32_t> begin_;        ///< (N + 1)
    std::vector<std::uint32_t> sides_;        ///< (2 contacts)
    mutable std::vector<Vec3> tip_velocity_;  ///< (N) W, scratch of apply_transpose
};

}  // namespace jostle
