#pragma once

#include <cmath>
#include <numbers>

#include "jostle/math/vec3.hpp"

namespace jostle {

/// A unit vector, uniform on the sphere, or in two dimensions on the circle z = 0, from two numbers uniform on (0, 1).
inline Vec3 random_direction(double u, double v, int dimensions = 3) {
    if (dimensions == 2)
        return normalised({std::cos(2.0 * std::numbers::pi * v), std::sin(2.0 * std::numbers::pi * v), 0});
    const double z = 2.0 * u - 1.0;
    const double radius = std::sqrt(1.0 - z * z), angle = 2.0 * std::numbers::pi * v;
    return normalised({radius * std::cos(angle), radius * std::sin(angle), z});
}

}  // namespace jostle
