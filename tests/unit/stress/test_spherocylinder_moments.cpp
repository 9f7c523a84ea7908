// Moments of a spherocylinder against an integration that knows nothing of the closed forms, and what follows from
// them.

#include <doctest/doctest.h>

#include <limits>

#include "jostle/error/input_error.hpp"
#include "jostle/rods/rods.hpp"
#include "jostle/stress/collision_stress.hpp"
#include "jostle/stress/spherocylinder_moments.hpp"
#include "quadrature.hpp"
#include "random_bodies.hpp"

using namespace jostle;
using namespace jostle::test;

TEST_CASE("closed forms of the moments equal the integrals") {
    for (const double length : {0.0, 0.3, 1.0, 2.5, 5.0, 20.0, 300.0}) {
        const double diameter = 1.3;
        const auto moments = spherocylinder_moments(length, diameter);
        const double volume = integrate<double>(length, diameter, [](const Vec3&) { return 1.0; });
        const Mat3 direct = integrate<Mat3>(length, diameter, [](const Vec3& x) { return outer(x, x); });
        const Mat3 expected_inertia =
            integrate<Mat3>(length, diameter, [](const Vec3& x) { return dot(x, x) * identity() - outer(x, x); });
        CHECK(volume == doctest::Approx(rod_volume(length, diameter)).epsilon(1e-13));
        CHECK(norm(second_moment(moments, {0, 0, 1}) - direct) < 1e-12 * norm(direct));
        CHECK(moments.inertia_parallel() == doctest::Approx(expected_inertia(2, 2)).epsilon(1e-12));
        CHECK(moments.inertia_perpendicular() == doctest::Approx(expected_inertia(0, 0)).epsilon(1e-12));
        const double anisotropy = (direct(2, 2) - direct(0, 0)) / (direct(2, 2) + direct(0, 0));
        CHECK(moment_anisotropy(length / diameter) == doctest::Approx(anisotropy).epsilon(1e-12));
    }
}

TEST_CASE("moment anisotropy B at the aspect ratios of the theory page") {
    CHECK(moment_anisotropy(0.0) == 0.0);
    const std::array<std::array<double, 2>, 6> listed = {
        {{1, .620}, {2.5, .868}, {3, .899}, {5, .956}, {10, .987}, {20, .997}}};
    for (const auto& [aspect_ratio, anisotropy] : listed) {
        CHECK(std::fabs(moment_anisotropy(aspect_ratio) - anisotropy) <= 5.01e-4);
    }
}

TEST_CASE("a spherocylinder's closed form is the general formula, for any axis and torque") {
    std::mt19937_64 generator(7);
    MESSAGE("seed 7");
    for (const double length : {0.0, 0.5, 2.5, 20.0}) {
        for (int k = 0; k < 50; ++k) {
            const Vec3 axis = random_direction(generator), torque = random_vector(generator);
            const Mat3 moment = second_moment(spherocylinder_moments(length, 0.8), axis);
            const Mat3 general = geometric_stress(moment, torque);
            CHECK(norm(geometric_stress_of_rod(axis, length, 0.8, torque) - general) < 1e-12 * norm(torque));
        }
    }
}

TEST_CASE("closed form in terms of the arm: s^G = (s/G_perp)(N_par n F_perp - N_perp F_perp n)") {
    std::mt19937_64 generator(8);
    MESSAGE("seed 8");
    const double length = 4.0, diameter = 1.1, arm = 1.7;
    const auto moments = spherocylinder_moments(length, diameter);
    for (int k = 0; k < 50; ++k) {
        const Vec3 axis = random_direction(generator), force = random_vector(generator);
        const Vec3 across = force - dot(axis, force) * axis;
        const Mat3 expected =
            (arm / moments.inertia_perpendicular()) * (moments.second_moment_parallel * outer(axis, across) -
                                                       moments.second_moment_perpendicular * outer(across, axis));
        const Vec3 torque = cross(arm * axis, force);
        CHECK(norm(geometric_stress_of_rod(axis, length, diameter, torque) - expected) < 1e-13 * norm(force));
    }
}

// An impulse J at x_C sets the rod in motion; its momentum, moment by moment of place, is r_M J + s^G.
TEST_CASE("momentum transfer through a spherocylinder, integrated over its volume") {
    std::mt19937_64 generator(9);
    MESSAGE("seed 9");
    const double length = 2.5, diameter = 1.0, density = 3.0;
    const auto moments = spherocylinder_moments(length, diameter);
    const double mass = density * rod_volume(length, diameter);
    for (int k = 0; k < 20; ++k) {
        const Vec3 centre = random_vector(generator), point = random_vector(generator),
                   impulse = random_vector(generator);
        const Vec3 torque = cross(point, impulse);
        const Vec3 velocity = impulse / mass;
        const Vec3 omega = {torque.x / (density * moments.inertia_perpendicular()),
                            torque.y / (density * moments.inertia_perpendicular()),
                            torque.z / (density * moments.inertia_parallel())};
        const Mat3 transfer = integrate<Mat3>(
            length, diameter, [&](const Vec3& x) { return density * outer(centre + x, velocity + cross(omega, x)); });
        const Mat3 expected =
            outer(centre, impulse) + geometric_stress(second_moment(moments, {0, 0, 1}), point, impulse);
        CHECK(norm(transfer - expected) < 1e-12 * norm(expected));
    }
}

TEST_CASE("no moments without a size") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(spherocylinder_moments(-1.0, 1.0), InputError);
    CHECK_THROWS_AS(spherocylinder_moments(nan, 1.0), InputError);
    CHECK_THROWS_AS(spherocylinder_moments(1.0, 0.0), InputError);
    CHECK_THROWS_AS(spherocylinder_moments(1.0, std::numeric_limits<double>::infinity()), InputError);
}
