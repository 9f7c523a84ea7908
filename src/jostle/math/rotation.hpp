#pragma once

#include "jostle/math/vec3.hpp"

namespace jostle {

/// The unit vector `axis` turned by the rotation vector `angle` (exponential map, Rodrigues' formula).
///
/// Exact for any angle; the last line only removes rounding, it does not replace the rotation.
inline Vec3 rotated(const Vec3& axis, const Vec3& angle) {
    const double theta_squared = squared_norm(angle);
    if (theta_squared == 0.0) return axis;
    const double theta = std::sqrt(theta_squared);
    const double half_sine = std::sin(0.5 * theta), half_cosine = std::cos(0.5 * theta);
    const double sine_over_theta = 2.0 * half_sine * half_cosine / theta;
    const double versine = 2.0 * half_sine * half_sine / theta_squared;
    const Vec3 turned = axis + sine_over_theta * cross(angle, axis) + versine * cross(angle, cross(angle, axis));
    return normalised(turned);
}

}  // namespace jostle
