#pragma once

#include "jostle/math/vec3.hpp"

namespace jostle {

/// Force and lever on a rod: the torque is axis x lever. Or the velocity of its centre, and W = Omega x axis. `lever`
/// is at right angles to the axis.
struct LineVector {
    Vec3 centre, lever;

    LineVector& operator+=(const LineVector& other) {
        centre += other.centre;
        lever += other.lever;
        return *this;
    }
};

inline Vec3 across(const Vec3& axis, const Vec3& vector) {
    return vector - dot(axis, vector) * axis;
}

}  // namespace jostle
