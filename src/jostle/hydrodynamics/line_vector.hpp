#pragma once

#include "jostle/math/vec3.hpp"

namespace jostle {

/// Force and moment on a rod: the torque is axis x moment. Or the velocity of its centre, and W = Omega x axis.
/// `moment` is at right angles to the axis.
struct LineVector {
    Vec3 centre, moment;

    LineVector& operator+=(const LineVector& other) {
        centre += other.centre;
        moment += other.moment;
        return *this;
    }
};

inline Vec3 across(const Vec3& axis, const Vec3& vector) {
    return vector - dot(axis, vector) * axis;
}

}  // namespace jostle
