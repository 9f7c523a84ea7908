#pragma once

#include <cstdint>

#include "jostle/rods/rod_mobility.hpp"

namespace jostle {

/// Two points on the axes of two rods, or of a rod and its own periodic image, and the direction between them.
///
///     i ===o======        arm: signed coordinate of the point on the rod's axis, from its centre
///          |  normal      distance: from the point of i to that of j
///     =====o====== j
struct PairOfPoints {
    std::uint32_t i = 0, j = 0;  ///< rows; equal for a rod and its own image
    double arm_i = 0.0, arm_j = 0.0;
    Vec3 normal;  ///< unit vector from i to j
    double distance = 0.0;
};

/// normal.(velocity of the rod's point at `arm`) for a unit force along `normal` at that point.
inline double point_mobility(const MobileRod& rod, const Vec3& normal, double arm) {
    const double along = dot(normal, rod.axis);
    const double across_squared = squared_norm(normal) - along * along;
    const RodMobility& m = rod.mobility;
    return m.parallel * along * along + (m.perpendicular + arm * arm * m.rotational) * across_squared;
}

/// How fast the two points (of a pair of points, or of a contact) move apart along the normal per force that pushes
/// them apart, for rods that feel their own drag only: (D^T M D)_ll of a contact there, if M does not couple rods.
template <class Points>
double relative_mobility(const Points& points, const MobileRod& i, const MobileRod& j) {
    if (points.i == points.j) {  // own image: the centre stays, only turning opens the gap
        const double along = dot(points.normal, i.axis);
        const double arm = points.arm_j - points.arm_i;
        return arm * arm * i.mobility.rotational * (squared_norm(points.normal) - along * along);
    }
    return point_mobility(i, points.normal, points.arm_i) + point_mobility(j, points.normal, points.arm_j);
}

}  // namespace jostle
