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

/// D_t, the mean over all directions: kT (parallel + 2 perpendicular)/3, in the plane kT (parallel + perpendicular)/2.
inline double translational_diffusion(double kT, const RodMobility& rod, int dimensions) {
    return kT * (rod.parallel + (dimensions - 1) * rod.perpendicular) / dimensions;
}

/// A rod as forces find it: its axis n, and its own mobility.
struct MobileRod {
    Vec3 axis;
    RodMobility mobility;
};

}  // namespace jostle
