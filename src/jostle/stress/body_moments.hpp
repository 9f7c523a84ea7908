#pragma once

#include <span>

#include "jostle/math/mat3.hpp"
#include "jostle/stress/rigid_body_stress.hpp"

// What a rigid body is for the stress formula (theory, eqs. 1.3 and 1.11): any shape, any density. The shapes are in
// shape_moments.hpp and mesh_moments.hpp; all have density 1 and stand about the origin. From there:
//     heavy = with_density(shape, 7.8);  turned = rotated(heavy, rotation);  there = moved(turned, {1, 0, 0});
//     composite = combined({{there, another}});  body = rigid_body(composite);

namespace jostle {

/// Mass, centre and second moment of a body of density rho(x).
struct BodyMoments {
    double mass = 0.0;   ///< M = int rho dV
    Vec3 centre;         ///< r_M = (1/M) int rho x dV, length: the centre of mass
    Mat3 second_moment;  ///< N = int rho (x - r_M)(x - r_M) dV, mass length^2
};

/// The body as `pair_stress` takes it; the mass drops out.
RigidBody rigid_body(const BodyMoments& body);

/// The same body of `density` times the density. Throws InputError unless density >= 0 and finite.
BodyMoments with_density(BodyMoments body, double density);

/// The body displaced by `displacement` (3, length).
BodyMoments moved(BodyMoments body, const Vec3& displacement);

/// The body turned about the origin: its centre becomes R r_M, its second moment R N R^T.
///
/// Throws InputError unless `rotation` (3 x 3) is one, as `require_rotation`.
BodyMoments rotated(const BodyMoments& body, const Mat3& rotation);

/// One rigid body made of several, by the parallel-axis theorem N = sum_k [N_k + M_k (r_k - r_M)(r_k - r_M)].
///
/// Where parts overlap, their densities add. Throws InputError unless all masses are >= 0, one is > 0, and all is
/// finite.
BodyMoments combined(std::span<const BodyMoments> parts);

/// The body of any density given by a sample: weight_k, the mass, at point_k.
///
/// `points` (n x 3, length), `weights` (n) >= 0, one of them > 0. A sample of n points drawn evenly from a volume has
/// moments right to about 1/sqrt(n). Throws InputError if sizes differ or a number is not allowed.
BodyMoments point_moments(std::span<const Vec3> points, std::span<const double> weights);

/// N = (tr(G)/2) I - G, of a body that is given by its moment of inertia G about the centre of mass.
///
/// Throws InputError unless G (3 x 3) is finite, symmetric, positive definite, and no principal moment is larger than
/// the sum of the other two (no body has such).
Mat3 second_moment_of_inertia(const Mat3& inertia);

/// Throws InputError unless R R^T = I to 1e-6, which admits numbers kept in single precision, and det R > 0.
void require_rotation(const Mat3& rotation);

}  // namespace jostle
