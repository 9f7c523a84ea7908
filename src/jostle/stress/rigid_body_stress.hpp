#pragma once

#include "jostle/math/mat3.hpp"
#include "jostle/stress/stress.hpp"

// The collision stress of two rigid bodies of any shape (Yan, Zhang & Shelley, J. Chem. Phys. 150, 064109 (2019)).
//
// A body of density rho(x) about its centre of mass has the second moment N = int rho x x dV and the inertia
// G = tr(N) I - N. An impulse J at x_C changes its velocities by DU = J/M and DOmega = G^-1 (x_C x J), and carries the
// momentum
//     int rho (r_M + x)(DU + DOmega x x) dV = r_M J + s^G,   s^G_ij = eps_jkl N_il [G^-1 (x_C x J)]_k
// through it. Forces stand for impulses: everything is linear in them. The scale of rho drops out.
//
// Departures from the paper:
// 1. The paper prints the geometric term of body 1 with +F; Newton's third law needs -F, and only then is the stress of
//    a frictionless pair symmetric. The authors' own program uses -F, too.

namespace jostle {

/// A rigid body of any shape and mass distribution.
struct RigidBody {
    Vec3 centre;         ///< centre of mass, length
    Mat3 second_moment;  ///< N = int rho x x dV about the centre of mass; any constant factor in rho is allowed
};

/// What one contact adds to the stress times the volume; the first index is that of the position, the second of the
/// force.
struct PairStress {
    Mat3 centre_of_mass_virial;  ///< (r_2 - r_1) F
    Mat3 geometric_1;            ///< s^G of body 1 under -F
    Mat3 geometric_2;            ///< s^G of body 2 under +F

    Mat3 total() const { return centre_of_mass_virial + geometric_1 + geometric_2; }

    /// eps:sigma, all that the antisymmetric part holds: (r_2 + x_2 - r_1 - x_1) x F, the torque of a force off the
    /// line between its two points; never dropped.
    Vec3 axial() const { return axial_vector(total()); }
    /// |sigma - sigma^T|/|sigma|, from 0 to 2.
    double asymmetry() const { return relative_asymmetry(total()); }
};

/// Which pair stress; all but `rigid_body` are here to compare with other programs. Symmetry alone singles out none.
enum class StressConvention {
    centre_of_mass_virial,  ///< (r_2 - r_1) F: asymmetric for rods
    centre_line,            ///< (r_2 + x_2 - r_1 - x_1) F, x on the centre lines (Snook et al. 2014): thin rods
    rigid_body              ///< theory, eq. (1.1): any shape
};

/// Stress times volume of one contact, sigma = (r_2 - r_1) F + s^G(2; x_2, +F) + s^G(1; x_1, -F) (theory, eq. 1.1).
///
/// `point_1`, `point_2` (3): where the force acts, relative to the bodies' centres; anywhere, not only on the surface.
/// `force` (3): on body 2, of any direction; body 1 feels -force. Symmetric where the force is parallel to the line
/// between the two points; otherwise eps:sigma = (r_2 + x_2 - r_1 - x_1) x F. Throws InputError where
/// `geometric_stress` does.
PairStress pair_stress(const RigidBody& body_1, const RigidBody& body_2, const Vec3& point_1, const Vec3& point_2,
                       const Vec3& force);

/// The same in a convention of choice; for `centre_line` the points must lie on the bodies' centre lines.
Mat3 pair_stress(StressConvention convention, const RigidBody& body_1, const RigidBody& body_2, const Vec3& point_1,
                 const Vec3& point_2, const Vec3& force);

/// Geometric stress s^G_ij = eps_jkl N_il [G^-1 (x_C x F)]_k of a body under a force F at x_C relative to its centre.
///
/// Traceless. Throws InputError if N is not finite, not symmetric, not positive semi-definite, or if G is singular (a
/// line).
Mat3 geometric_stress(const Mat3& second_moment, const Vec3& application_point, const Vec3& force);

/// The same from the torque on the body, in which it is linear: sums over contacts become sums over bodies.
Mat3 geometric_stress(const Mat3& second_moment, const Vec3& torque);

/// Moment of inertia G = tr(N) I - N.
Mat3 inertia(const Mat3& second_moment);

}  // namespace jostle
