#pragma once

#include "jostle/math/mat3.hpp"

namespace jostle {

/// The unit vector `axis` turned by the rotation vector `angle` (exponential map, Rodrigues' formula).
///
/// Exact for any angle; the last line only removes rounding, it does not replace the rotation.
inline Vec3 rotated(const Vec3& axis, const Vec3& angle) {
    const double t = squared_norm(angle);
    double sine_over_theta, versine;  // sin(theta)/theta, (1 - cos(theta))/theta^2
    if (t < 0.25) {                   // their series, to rounding: most steps turn rods by little
        constexpr double c2 = 1.0 / 2, c3 = c2 / 3, c4 = c3 / 4, c5 = c4 / 5, c6 = c5 / 6, c7 = c6 / 7, c8 = c7 / 8,
                         c9 = c8 / 9, c10 = c9 / 10, c11 = c10 / 11, c12 = c11 / 12, c13 = c12 / 13, c14 = c13 / 14;
        sine_over_theta = 1.0 - t * (c3 - t * (c5 - t * (c7 - t * (c9 - t * (c11 - t * c13)))));
        versine = c2 - t * (c4 - t * (c6 - t * (c8 - t * (c10 - t * (c12 - t * c14)))));
    } else {
        const double theta = std::sqrt(t);
        const double half_sine = std::sin(0.5 * theta), half_cosine = std::cos(0.5 * theta);
        sine_over_theta = 2.0 * half_sine * half_cosine / theta;
        versine = 2.0 * half_sine * half_sine / t;
    }
    const Vec3 across = cross(angle, axis);
    const Vec3 turned = axis + sine_over_theta * across + versine * cross(angle, across);
    return (1.5 - 0.5 * squared_norm(turned)) * turned;  // a step of Newton's towards length 1
}

/// The rotation matrix of the quaternion w + x i + y j + z k, of any length but 0: its columns are the turned axes.
inline Mat3 rotation_of_quaternion(double w, double x, double y, double z) {
    const double scale = 2.0 / (w * w + x * x + y * y + z * z);
    return Mat3{{1.0 - scale * (y * y + z * z), scale * (x * y - w * z), scale * (x * z + w * y),  //
                 scale * (x * y + w * z), 1.0 - scale * (x * x + z * z), scale * (y * z - w * x),  //
                 scale * (x * z - w * y), scale * (y * z + w * x), 1.0 - scale * (x * x + y * y)}};
}

}  // namespace jostle
