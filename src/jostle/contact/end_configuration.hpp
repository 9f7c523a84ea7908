#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "jostle/contact/contact_matrix.hpp"
#include "jostle/contact/pair_contacts.hpp"
#include "jostle/rods/configuration.hpp"
#include "jostle/rods/velocities.hpp"

namespace jostle {

/// How contact forces displace a rod in a step: its centre, and its ends to both sides of that; and an upper bound for
/// any point.
struct Displacement {
    std::array<float, 3> centre{}, end{};
    float farthest = 0.0F;
    float inaccuracy = 0.0F;  ///< of centre and end together, at most
};

/// Centre and axis of a rod at the end of a step, by U_known + U_C. `arm_axis`: that of the arms of its contacts.
inline Vec3 centre_at_end(const Rods& rods, std::uint32_t row, const Velocities& known,
                          const ContactVelocity& by_contacts, double time_step) {
    return centre_after(rods.centre[row], known.linear[row] + by_contacts.centre, time_step);
}
inline Vec3 axis_at_end(const Rods& rods, std::uint32_t row, const Velocities& known,
                        const ContactVelocity& by_contacts, const Vec3& arm_axis, double time_step) {
    return axis_after(rods.axis[row], known.angular[row] + cross(arm_axis, by_contacts.axis_rate), time_step);
}

/// The rods that have contacts, as the contact matrix numbers them.
struct RodsWithContacts {
    std::span<const std::uint32_t> local_index;  ///< (N) a rod's number among them, or no_local_index
    std::span<const std::uint32_t> rows;         ///< (n)
    std::span<const MobileRod> arms;             ///< (n) the axes of their arms (ArmAxes)
};

/// Rods at the end of a step in which contact forces act: those with contacts where the forces take them, the others
/// where the known motion does. `set_velocities` comes first. Rods are worked out when asked for: few are, unless
/// `place_rods` was called. Holds references, and the spans of RodsWithContacts, which last until the contact matrix is
/// extended.
class EndConfiguration {
public:
    /// `rods`: as the step begins. `known`: (N) after the known motion.
    EndConfiguration(const Rods& rods, const Velocities& known_velocity, const Configuration& known, double time_step)
        : rods_(rods), known_velocity_(known_velocity), known_(known), time_step_(time_step) {}

    /// Makes it that of forces by which rods have the sum of these velocities, each (n), or shorter, if there are more
    /// rods with contacts since.
    void set_velocities(const RodsWithContacts& with_contacts,
                        std::initializer_list<std::span<const ContactVelocity>> parts);

    /// Works out `displacements`.
    void find_displacements();

    /// Works out all rods with contacts: pays where each is asked for more than once.
    void place_rods();

    const Rods& rods() const { return rods_; }                                     ///< as the step begins
    std::span<const std::uint32_t> rows() const { return with_contacts_.rows; }    ///< (n) of rods with contacts
    std::span<const Displacement> displacements() const { return displacement_; }  ///< (n) what forces add

    Vec3 centre(std::uint32_t row) const {
        const std::uint32_t local = with_contacts_.local_index[row];
        if (local == no_local_index) return known_.centre[row];
        return local < placed_centre_.size() ? placed_centre_[local] : displaced_centre(local);
    }
    Vec3 axis(std::uint32_t row) const {
        const std::uint32_t local = with_contacts_.local_index[row];
        if (local == no_local_index) return known_.axis[row];
        return local < placed_axis_.size() ? placed_axis_[local] : displaced_axis(local);
    }
    /// The pair of rods as it is there.
    PairGeometry pair(const Box& box, const PairKey& key) const {
        const Vec3 centre_separation = centre(key.j) + box.displacement(key.image) - centre(key.i);
        return pair_geometry(rods_, key.i, key.j, centre_separation, axis(key.i), axis(key.j));
    }

private:
    /// What a displacement needs of a rod.
    struct Turning {
        double half_length, by_known_motion;  ///< a length; an angle
    };

    Vec3 displaced_centre(std::size_t local) const {
        return centre_at_end(rods_, with_contacts_.rows[local], known_velocity_, velocity_[local], time_step_);
    }
    Vec3 displaced_axis(std::size_t local) const {
        return axis_at_end(rods_, with_contacts_.rows[local], known_velocity_, velocity_[local],
                           with_contacts_.arms[local].axis, time_step_);
    }
    Displacement displacement_of(std::size_t local) const;

    const Rods& rods_;
    const Velocities& known_velocity_;
    const Configuration& known_;
    double time_step_;
    RodsWithContacts with_contacts_;
    std::vector<ContactVelocity> velocity_;          ///< (n) by contact forces
    std::vector<Displacement> displacement_;         ///< (n) once they are found
    std::vector<Turning> turning_;                   ///< (n) once displacements are found
    std::vector<Vec3> placed_centre_, placed_axis_;  ///< (n) after `place_rods`, else none
};

}  // namespace jostle
