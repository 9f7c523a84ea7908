#pragma once

#include <cstddef>
#include <vector>

#include "jostle/math/rotation.hpp"
#include "jostle/math/vec3.hpp"

namespace jostle {

/// Where rods are at one moment of a step.
struct Configuration {
    std::vector<Vec3> centre;  ///< (N) not wrapped into the box
    std::vector<Vec3> axis;    ///< (N) unit vectors

    std::size_t size() const { return centre.size(); }
    void resize(std::size_t count) {
        centre.resize(count);
        axis.resize(count);
    }
};

/// Where a rod is that moves with this velocity for so long, and this angular velocity: q + U t, the axis by the
/// exponential map (theory 2.4).
inline Vec3 centre_after(const Vec3& centre, const Vec3& velocity, double time) {
    return centre + time * velocity;
}
inline Vec3 axis_after(const Vec3& axis, const Vec3& angular_velocity, double time) {
    return rotated(axis, time * angular_velocity);
}

/// The axis of a rod that has done this part of a turn that is far from half a round: 0 `before`, 1/2 in the middle, 1
/// `after`.
inline Vec3 axis_between(const Vec3& before, const Vec3& after, double part) {
    return normalised(before + part * (after - before));
}

}  // namespace jostle
