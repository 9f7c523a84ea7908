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

/// Rods at the end of a step in which contact forces act: those with contacts where the forces take them, the others
/// where the known motion does. Worked out when asked for: few are, unless `place_rods` was called. Holds references,
/// and spans of the contact matrix, which last until that is extended.
struct EndConfiguration {
    const Rods& rods;                  ///< as the step begins
    const Velocities& known_velocity;  ///< (N)
    const Configuration& known;        ///< (N) after the known motion
    double time_step;
    std::span<const std::uint32_t> local_index{};  ///< (N) a rod's number among those with contacts, or no_local_index
    std::span<const std::uint32_t> rows{};         ///< (n) of the rods with contacts
    std::span<const MobileRod> arms{};             ///< (n) the axes of their arms (ArmAxes)
    std::vector<ContactVelocity> velocity{};       ///< (n) theirs by contact forces
    std::vector<Displacement> displacement{};      ///< (n) what these add to the known motion, once it is found
    /// What a displacement needs of a rod.
    struct Turning {
        double half_length, by_known_motion;  ///< a length; an angle
    };
    std::vector<Turning> turning{};                    ///< (n) once displacements are found
    std::vector<Vec3> placed_centre{}, placed_axis{};  ///< (n) after `place_rods`, else none

    /// Makes it that of forces by which rods have the sum of these velocities, each (n) as the matrix numbers rods, or
    /// shorter, if that has grown since. `arms_of_rods`: (n), as the contact problem has them.
    void set_velocities(const ContactMatrix& contact_matrix, std::span<const MobileRod> arms_of_rods,
                        std::initializer_list<std::span<const ContactVelocity>> parts);

    void find_displacements();

    /// Works out all rods with contacts: pays where each is asked for more than once.
    void place_rods();

    Vec3 centre(std::uint32_t row) const {
        const std::uint32_t local = local_index[row];
        if (local == no_local_index) return known.centre[row];
        if (local < placed_centre.size()) return placed_centre[local];
        return centre_at_end(rods, row, known_velocity, velocity[local], time_step);
    }
    Vec3 axis(std::uint32_t row) const {
        const std::uint32_t local = local_index[row];
        if (local == no_local_index) return known.axis[row];
        if (local < placed_axis.size()) return placed_axis[local];
        return axis_at_end(rods, row, known_velocity, velocity[local], arms[local].axis, time_step);
    }
    /// The pair of rods as it is there.
    PairGeometry pair(const Box& box, const PairKey& key) const {
        const Vec3 centre_separation = centre(key.j) + box.displacement(key.image) - centre(key.i);
        return pair_geometry(rods, key.i, key.j, centre_separation, axis(key.i), axis(key.j));
    }
};

}  // namespace jostle
