#pragma once

#include <cstddef>
#include <span>

#include "jostle/rods/configuration.hpp"

namespace jostle {

/// The axes along which arms of contacts lie, and about which contact forces turn rods: those of the same moment as
/// normals and arms, after a part of the known motion (theory, section 3). Holds references.
struct ArmAxes {
    std::span<const Vec3> before;   ///< (N) as the step begins
    std::span<const Vec3> after{};  ///< (N) after the known motion; needed if `part` is above 0
    double part = 0.0;              ///< 0 to 1

    Vec3 operator()(std::size_t row) const {
        return part == 0.0 ? before[row] : axis_between(before[row], after[row], part);
    }
};

}  // namespace jostle
