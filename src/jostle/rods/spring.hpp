#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "jostle/rods/box.hpp"
#include "jostle/rods/forces.hpp"

namespace jostle {

/// A spring between a point of rod 1 and a point of rod 2: it pulls with stiffness (distance - rest_length).
///
///        1 ======o==         s: signed coordinate of the point on the rod's axis, from its centre, |s| <= length/2
///                 \.
///              ====o====== 2
struct Spring {
    std::uint64_t rod_1 = 0, rod_2 = 0;  ///< ids
    double s_1 = 0.0, s_2 = 0.0;         ///< length
    double rest_length = 0.0;            ///< >= 0
    double stiffness = 0.0;              ///< >= 0, force/length
    /// The copy of rod 2 that it holds, counted from the unwrapped places: point 2 is at unwrapped_2 + image * edges.
    /// Rods that cross an edge of a periodic box do not change it.
    Image image{};

    bool operator==(const Spring&) const = default;
};

/// What a spring does as the rods stand.
struct SpringPull {
    std::uint32_t row_1 = 0, row_2 = 0;
    Vec3 shift;      ///< from the centre in row 2 to that of the copy that the spring holds
    Vec3 direction;  ///< unit vector from point 1 to point 2; 0 where they coincide, and there is no force
    Vec3 force;      ///< on rod 2; rod 1 feels -force

    /// From point 1 to point 2, for rods that stand at these places.
    Vec3 separation(const Spring& spring, std::span<const Vec3> centre, std::span<const Vec3> axis) const {
        return centre[row_2] + shift + spring.s_2 * axis[row_2] - centre[row_1] - spring.s_1 * axis[row_1];
    }
};

/// All pulls, one a spring (theory, eq. 2.16). Throws InputError if there is no rod of that id.
std::vector<SpringPull> spring_pulls(std::span<const Spring> springs, const Rods& rods, const Box& box);

/// Forces and torques (N) of the springs on all rods.
Forces spring_forces(std::span<const Spring> springs, std::span<const SpringPull> pulls, const Rods& rods);

/// Lets every spring hold the copy of rod 2 that is nearest to rod 1 now. Errors: as `spring_pulls`.
void hold_nearest_images(std::vector<Spring>& springs, const Rods& rods, const Box& box);

}  // namespace jostle
