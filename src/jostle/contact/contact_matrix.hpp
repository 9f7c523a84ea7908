#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "jostle/contact/arm_axes.hpp"
#include "jostle/contact/contacts.hpp"
#include "jostle/rods/forces.hpp"
#include "jostle/rods/velocities.hpp"

namespace jostle {

/// Force F on a rod, and the sum of arm * force over its contacts: its torque is axis x moment.
struct ContactForce {
    Vec3 force, moment;
};

/// Velocity U of a rod's centre, and W = Omega x axis: a point at `arm` along the axis has the velocity U + arm W.
struct ContactVelocity {
    Vec3 centre, axis_rate;
};

/// Makes entry k of `forces` what this contact force is to a rod with this axis.
inline void set_force(const ContactForce& force, const Vec3& axis, std::size_t k, Forces& forces) {
    forces.force[k] = force.force;
    forces.torque[k] = cross(axis, force.moment);
}
/// What entry k of `velocities` is to the contacts of a rod with this axis.
inline ContactVelocity contact_velocity(const Velocities& velocities, std::size_t k, const Vec3& axis) {
    return {velocities.linear[k], cross(velocities.angular[k], axis)};
}

/// How fast the gap of a contact (or what else has its normal and arms) opens, D^T U.
template <class ContactLike>
double gap_rate(const ContactLike& contact, const ContactVelocity& i, const ContactVelocity& j) {
    return dot(contact.normal, j.centre + contact.arm_j * j.axis_rate - i.centre - contact.arm_i * i.axis_rate);
}

/// The same where rods (N) move with these velocities; fixed bodies stay.
inline double gap_rate(const Contact& contact, const ArmAxes& axes, const Velocities& velocities) {
    const auto velocity = [&](std::uint32_t body) {
        return is_fixed(body) ? ContactVelocity{} : contact_velocity(velocities, body, axes(body));
    };
    return gap_rate(contact, velocity(contact.i), velocity(contact.j));
}

/// Adds D gamma of a contact to what acts on its two rods.
template <class ContactLike>
void add_contact_force(double gamma, const ContactLike& contact, ContactForce& on_i, ContactForce& on_j) {
    const Vec3 force = gamma * contact.normal;
    on_i.force -= force;
    on_i.moment -= contact.arm_i * force;
    on_j.force += force;
    on_j.moment += contact.arm_j * force;
}

/// The matrix D of theory, eq. (2.2), between contact forces gamma and the rods that have contacts. Never formed.
///
/// Column l is (-normal, -a_i x normal; +normal, +a_j x normal) with arms a = arm * axis. As an arm is along its rod's
/// axis, no cross product is needed per contact:
///     D gamma:  force = sum of +- gamma normal,  moment = sum of +- arm gamma normal,
///     D^T U:    normal.(U_j + arm_j W_j - U_i - arm_i W_i).
/// Rods without contacts have no part unless asked for: the others are numbered apart ("local index", in the order of
/// their first contacts). Fixed bodies have none. Holds a reference: the contacts must outlive it, and may only grow,
/// as `extend` is then told.
class ContactMatrix {
public:
    enum class Include { rods_with_contacts, all_rods };

    /// `ids`: (N) of the rows that contacts refer to. Held by reference, too. `always_from`: this row and those
    /// that follow have a part in any case.
    ContactMatrix(const Contacts& contacts, std::span<const std::uint64_t> ids,
                  Include include = Include::rods_with_contacts,
                  std::size_t always_from = std::numeric_limits<std::size_t>::max());

    /// Takes in the contacts that have been appended since.
    void extend();

    /// Where a contact's rods stand among those with contacts; i of a fixed body: `no_local_index`.
    struct RodPair {
        std::uint32_t i, j;
    };

    std::size_t size() const { return rod_pairs_.size(); }
    const Contacts& contacts() const { return contacts_; }
    std::span<const std::uint32_t> rods() const { return rows_; }      ///< (n) row of each
    std::span<const RodPair> rod_pairs() const { return rod_pairs_; }  ///< (contacts) local indices

    /// Of the bodies of contact l.
    std::uint64_t id_of_i(std::size_t l) const { return id_of_body(contacts_.contact[l].i, ids_); }
    std::uint64_t id_of_j(std::size_t l) const { return ids_[contacts_.contact[l].j]; }

    /// (N) local index of each row, or `no_local_index`.
    std::span<const std::uint32_t> local_index() const { return local_index_; }

    /// forces = D gamma, one a rod with contacts; `gamma`: one force a contact, positive where the rods repel each
    /// other.
    void apply(std::span<const double> gamma, std::span<ContactForce> forces) const;

    /// Adds D gamma of contact l to the forces on its rods.
    void add_force(std::size_t l, double gamma, std::span<ContactForce> forces) const {
        ContactForce on_fixed_body;
        const auto [i, j] = rod_pairs_[l];
        add_contact_force(gamma, contacts_.contact[l], i == no_local_index ? on_fixed_body : forces[i], forces[j]);
    }

    /// rates = D^T velocities: the velocity at which each gap opens. Fixed bodies stay.
    void apply_transpose(std::span<const ContactVelocity> velocities, std::span<double> rates) const;

private:
    std::uint32_t numbered(std::uint32_t row);
    void list_incidence() const;

    const Contacts& contacts_;
    std::span<const std::uint64_t> ids_;
    std::vector<std::uint32_t> local_index_;  ///< (N)
    std::vector<std::uint32_t> rows_;
    std::vector<RodPair> rod_pairs_;
    /// Contacts of each local index: 2 l where the rod is i of contact l, 2 l + 1 where it is j; in the order of the
    /// other rods' ids, of the same other rod as the contacts stand. Each rod gathers its own forces, in this order, so
    /// that the sum depends neither on threads nor on where rods stand in memory. Made when first needed.
    mutable std::vector<std::uint32_t> begin_;      ///< (n + 1)
    mutable std::vector<std::uint32_t> incidence_;  ///< (sides that are rods)
};

}  // namespace jostle
