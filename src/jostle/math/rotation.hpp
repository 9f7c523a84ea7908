#pragma once

#include "jostle/math/mat3.hpp"

namespace jostle {

/// The unit vector `axis` turned by the rotation vector `angle` (exponential map, Rodrigues' formula).
///
/// Exact for any angle; the last line only removes rounding, it does not replace the rotation.
inline Vec3 rotated(const Vec3& axis, const Vec3& angle) {
    const double theta_squared = squared_norm(angle);
    if (theta_squared == 0.0) return axis;
    double sine_over_theta = 1.0, versine = 0.5;  // sin(theta)/theta, (1 - cos(theta))/theta^2
    if (theta_squared < 0.25) {                   // their series, to rounding: most steps turn rods by little
        const double t = theta_squared;
        sine_over_theta =
            1.0 -
            t / 6.0 * (1.0 - t / 20.0 * (1.0 - t / 42.0 * (1.0 - t / 72.0 * (1.0 - t / 110.0 * (1.0 - t / 156.0)))));
        versine =
            0.5 -
            t / 24.0 * (1.0 - t / 30.0 * (1.0 - t / 56.0 * (1.0 - t / 90.0 * (1.0 - t / 132.0 * (1.0 - t / 182.0)))));
    } else {
        const double theta = std::sqrt(theta_squared);
        const double half_sine = std::sin(0.5 * theta), half_cosine = std::cos(0.5 * theta);
        sine_over_theta = 2.0 * half_sine * half_cosine / theta;
        versine = 2.0 * half_sine * half_sine / theta_squared;
    }
    const Vec3 turned = axis + sine_over_theta * cross(angle, axis) + versine * cross(angle, cross(angle, axis));
    return normalised(turned);
}

/// The rotation matrix of the quaternion w + x i + y j + z k, of any length but 0: its columns are the turned axes.
inline Mat3 rotation_of_quaternion(double w, double x, double y, double z) {
    const double scale = 2.0 / (w * w + x * x + y * y + z * z);
    return Mat3{{1.0 - scale * (y * y + z * z), scale * (x * y - w * z), scale * (x * z + w * y),  //
                 scale * (x * y + w * z), 1.0 - scale * (x * x + z * z), scale * (y * z - w * x),  //
                 scale * (x * z - w * y), scale * (y * z + w * x), 1.0 - scale * (x * x + y * y)}};
}

}  // namespace jostle
