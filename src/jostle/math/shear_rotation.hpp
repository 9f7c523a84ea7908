#pragma once

#include <cmath>

#include "jostle/math/vec3.hpp"

namespace jostle {

/// How a simple shear, u = rate y along x, turns the axes of bodies of one shape in a time: as Jeffery's equation has
/// it, exactly, for a strain of any size (theory, eq. 8.3).
///
/// exp of K = [[0, (1 + lambda)/2], [-(1 - lambda)/2, 0]] strain in the plane xy, for K^2 = -angle^2 there.
class ShearRotation {
public:
    /// `lambda`: Bretherton's parameter, above -1 and below 1.
    ShearRotation(double strain, double lambda) {
        const double angle = 0.5 * strain * std::sqrt((1.0 - lambda) * (1.0 + lambda));
        const double along = 0.5 * strain * (angle == 0.0 ? 1.0 : std::sin(angle) / angle);
        cosine_ = std::cos(angle);
        x_of_y_ = along * (1.0 + lambda);
        y_of_x_ = -along * (1.0 - lambda);
    }

    /// `axis`: a unit vector, as is the result.
    Vec3 of(const Vec3& axis) const {
        return normalised({cosine_ * axis.x + x_of_y_ * axis.y, y_of_x_ * axis.x + cosine_ * axis.y, axis.z});
    }

private:
    double cosine_, x_of_y_, y_of_x_;
};

}  // namespace jostle
