#include "jostle/stress/rigid_body_stress.hpp"

#include <fmt/format.h>

#include "jostle/error/input_error.hpp"
#include "jostle/error/refuse.hpp"
#include "jostle/math/symmetric_eigen.hpp"

namespace jostle {

namespace {

[[noreturn]] void refuse_second_moment(const Mat3& second_moment, const std::string& problem) {
    refuse("second_moment", fmt::format("{}", fmt::join(second_moment.m, " ")), problem,
           "finite, symmetric, positive semi-definite, and not of a body without width");
}

/// Eigenvalues (ascending) and axes of N, or InputError.
SymmetricEigen checked_eigen(const Mat3& second_moment) {
    for (double value : second_moment.m)
        if (!std::isfinite(value)) refuse_second_moment(second_moment, "must be finite");
    const double size = norm(second_moment);
    if (norm(second_moment - transpose(second_moment)) > 1e-12 * size)
        refuse_second_moment(second_moment, "must be symmetric");
    const SymmetricEigen eigen = symmetric_eigen(second_moment);
    if (eigen.values[0] < -1e-12 * size) refuse_second_moment(second_moment, "has a negative eigenvalue");
    // The smallest eigenvalue of G is the sum of the two smaller ones of N; 1e-14 admits rods up to L/D = 1e7.
    if (!(eigen.values[0] + eigen.values[1] > 1e-14 * size))
        refuse_second_moment(second_moment, "gives an inertia that is singular");
    return eigen;
}

/// G^-1 torque, on the axes of N, which are those of G.
Vec3 angular_velocity(const SymmetricEigen& eigen, const Vec3& torque) {
    Vec3 omega;
    for (std::size_t k = 0; k < 3; ++k) {
        const double inertia_k = eigen.values[(k + 1) % 3] + eigen.values[(k + 2) % 3];
        omega += (dot(eigen.vectors[k], torque) / inertia_k) * eigen.vectors[k];
    }
    return omega;
}

}  // namespace

PairStress pair_stress(const RigidBody& body_1, const RigidBody& body_2, const Vec3& point_1, const Vec3& point_2,
                       const Vec3& force) {
    return {outer(body_2.centre - body_1.centre, force), geometric_stress(body_1.second_moment, point_1, -force),
            geometric_stress(body_2.second_moment, point_2, force)};
}

Mat3 pair_stress(StressConvention convention, const RigidBody& body_1, const RigidBody& body_2, const Vec3& point_1,
                 const Vec3& point_2, const Vec3& force) {
    const Vec3 separation = body_2.centre - body_1.centre;
    switch (convention) {
        case StressConvention::centre_of_mass_virial:
            return outer(separation, force);
        case StressConvention::centre_line:
            return outer(separation + point_2 - point_1, force);
        case StressConvention::rigid_body:
            break;
    }
    return pair_stress(body_1, body_2, point_1, point_2, force).total();
}

Mat3 geometric_stress(const Mat3& second_moment, const Vec3& application_point, const Vec3& force) {
    return geometric_stress(second_moment, cross(application_point, force));
}

Mat3 geometric_stress(const Mat3& second_moment, const Vec3& torque) {
    const Vec3 omega = angular_velocity(checked_eigen(second_moment), torque);
    Mat3 stress;
    for (int i = 0; i < 3; ++i) {
        // Row i: eps_jkl omega_k N_il = (omega x N_i)_j
        const Vec3 row = cross(omega, {second_moment(i, 0), second_moment(i, 1), second_moment(i, 2)});
        for (int j = 0; j < 3; ++j) stress(i, j) = row[j];
    }
    return stress;
}

Mat3 inertia(const Mat3& second_moment) {
    return trace(second_moment) * identity() - second_moment;
}

}  // namespace jostle
