#pragma once

#include "jostle/math/vec3.hpp"

namespace jostle {

/// How one rod alone answers to force and torque: U = [parallel n n + perpendicular (I - n n)] F, Omega = rotational (I
/// - n n) T.
///
/// Spin about the axis moves nothing that jostle sees, so it is left out.
struct RodMobility {
    double parallel = 0.0;       ///< velocity per force along the axis
    double perpendicular = 0.0;  ///< velocity per force across the axis
    double rotational = 0.0;     ///< angular velocity per torque across the axis
};

/// A rod as forces find it: its axis n, and its own mobility.
struct MobileRod {
    Vec3 axis;
    RodMobility mobility;
};

}  // namespace jostle
