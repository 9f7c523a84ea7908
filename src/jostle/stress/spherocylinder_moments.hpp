#pragma once

#include "jostle/math/mat3.hpp"

namespace jostle {

/// Moments of a spherocylinder of density 1 about its centre, along and across its axis; length^5.
struct SpherocylinderMoments {
    double second_moment_parallel = 0.0;       ///< N_par = int z^2 dV, z along the axis
    double second_moment_perpendicular = 0.0;  ///< N_perp = int x^2 dV

    double inertia_parallel() const { return 2.0 * second_moment_perpendicular; }
    double inertia_perpendicular() const { return second_moment_parallel + second_moment_perpendicular; }
};

/// N_par = (10 b^3 + 20 b^2 + 15 b + 4) pi R^5/15, N_perp = (15 b + 8) pi R^5/30 with b = length/diameter, R =
/// diameter/2.
///
/// `length` of the cylinder part, >= 0 (0: a sphere); `diameter` > 0. Throws InputError otherwise.
SpherocylinderMoments spherocylinder_moments(double length, double diameter);

/// The second moment N = N_perp (I - n n) + N_par n n of a spherocylinder with the unit axis n.
Mat3 second_moment(const SpherocylinderMoments& moments, const Vec3& axis);

/// B = (N_par - N_perp)/(N_par + N_perp) of a spherocylinder of aspect ratio b = L/D >= 0: 0 for a sphere, 1 for a
/// needle.
///
/// The only number of the shape that the geometric stress knows. Not checked: it stands inside the loop over rods.
inline double moment_anisotropy(double aspect_ratio) {
    const double b = aspect_ratio;
    return 5.0 * b * (2.0 * b + 1.0) * (2.0 * b + 3.0) / (((20.0 * b + 40.0) * b + 45.0) * b + 16.0);
}

}  // namespace jostle
