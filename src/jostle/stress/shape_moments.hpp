#pragma once

#include "jostle/stress/body_moments.hpp"

// Moments of shapes of density 1 about the origin (theory, eqs. 1.5 and 1.12). Sizes are lengths. `orientation` is a
// rotation matrix whose columns are the directions of the shape's own axes; InputError where it is none.

namespace jostle {

/// M = pi D^3/6, N = (M D^2/20) I. Throws InputError unless diameter > 0 and finite.
BodyMoments sphere_moments(double diameter);

/// N = N_perp (I - n n) + N_par n n of theory, eq. (1.5). A sphere has length 0.
///
/// `axis` (3) unit vector to 1e-6; `length` >= 0 of the cylinder part; `diameter` > 0. Throws InputError otherwise.
BodyMoments spherocylinder_moments(const Vec3& axis, double length, double diameter);

/// M = a b c, N = (M/12) diag(a^2, b^2, c^2) along its own axes. Throws InputError unless all edges are > 0 and finite.
BodyMoments box_moments(const Vec3& edges, const Mat3& orientation = identity());

/// M = 4 pi a b c/3, N = (M/5) diag(a^2, b^2, c^2) along its own axes. Throws InputError unless all semi-axes are > 0.
BodyMoments ellipsoid_moments(const Vec3& semi_axes, const Mat3& orientation = identity());

/// Spheres that move as one. What two spheres share counts twice: weigh it out with `combined` and `with_density`, or
/// take a mesh or `point_moments`, where that matters.
///
/// `centres` (n x 3), `diameters` (n) > 0, n >= 1. Throws InputError otherwise.
BodyMoments clump_moments(std::span<const Vec3> centres, std::span<const double> diameters);

}  // namespace jostle
