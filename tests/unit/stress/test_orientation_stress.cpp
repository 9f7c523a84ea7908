// The orientation stress -3 kT B (n n - I/3) of rods, by hand.

#include <doctest/doctest.h>

#include "jostle/parallel/parallel_for.hpp"
#include "jostle/stress/orientation_stress.hpp"
#include "jostle/stress/spherocylinder_moments.hpp"
#include "random_bodies.hpp"

using namespace jostle;
using namespace jostle::test;

namespace {

Rods rods_along(const std::vector<Vec3>& axes, double length, double diameter) {
    Rods rods;
    for (const Vec3& axis : axes) rods.push_back(rods.size(), {}, axis, length, diameter);
    return rods;
}

}  // namespace

TEST_CASE("one rod along z: -2 kT B along it, kT B across") {
    // B = 5 b (2b + 1)(2b + 3)/(20 b^3 + 40 b^2 + 45 b + 16) with b = 2: 350/426.
    const double kT = 0.3, B = 350.0 / 426.0;
    const Mat3 stress = orientation_stress_of_rod({0, 0, 1}, 4.0, 2.0, kT);
    const Mat3 expected = (kT * B) * Mat3{{1, 0, 0, 0, 1, 0, 0, 0, -2}};
    CHECK(norm(stress - expected) < 1e-15);
    // At 45 degrees between x and z: n n has 1/2 in xx, xz, zx, zz.
    const double half = std::sqrt(0.5);
    const Mat3 tilted = orientation_stress_of_rod({half, 0, half}, 4.0, 2.0, kT);
    const Mat3 by_hand = (kT * B) * Mat3{{-0.5, 0, -1.5, 0, 1, 0, -1.5, 0, -0.5}};
    CHECK(norm(tilted - by_hand) < 1e-15);
}

TEST_CASE("aligned rods: N times that of one; three at right angles: nothing") {
    const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    const Mat3 aligned = sum_of_orientation_stresses(rods_along({z, -z, z, z}, 5.0, 1.0), 1.5);
    CHECK(norm(aligned - 4.0 * orientation_stress_of_rod(z, 5.0, 1.0, 1.5)) < 1e-14);
    CHECK(norm(sum_of_orientation_stresses(rods_along({x, y, z}, 5.0, 1.0), 1.5)) < 1e-15);
}

TEST_CASE(
    "where lengths differ every rod has its own B; a sphere, and a box without temperature, have exactly nothing") {
    Rods rods = rods_along({{0, 0, 1}}, 1.0, 1.0);
    rods.push_back(1, {}, {1, 0, 0}, 10.0, 2.0);
    rods.push_back(2, {}, {0, 1, 0}, 0.0, 1.0);
    const double short_B = moment_anisotropy(1.0), long_B = moment_anisotropy(5.0);
    const Mat3 sum = sum_of_orientation_stresses(rods, 2.0);
    CHECK(sum(0, 0) == doctest::Approx(2.0 * short_B - 4.0 * long_B));
    CHECK(sum(1, 1) == doctest::Approx(2.0 * short_B + 2.0 * long_B));
    CHECK(sum(2, 2) == doctest::Approx(-4.0 * short_B + 2.0 * long_B));
    CHECK(orientation_stress_of_rod({0, 1, 0}, 0.0, 1.0, 2.0).m == Mat3{}.m);
    CHECK(sum_of_orientation_stresses(rods, 0.0).m == Mat3{}.m);
    for (const double element : sum_of_orientation_stresses(rods, 0.0).m) CHECK_FALSE(std::signbit(element));
}

TEST_CASE("equal rods: -2 N kT B Q; symmetric, traceless, the same bits for any number of threads") {
    std::mt19937_64 generator(27);
    MESSAGE("seed 27");
    std::vector<Vec3> axes(3000);
    for (Vec3& axis : axes) axis = random_direction(generator);
    const Rods rods = rods_along(axes, 5.0, 1.0);
    parallel::set_thread_count(1);
    const Mat3 sum = sum_of_orientation_stresses(rods, 0.7);
    Mat3 order;  // N Q
    for (const Vec3& axis : axes) order += 0.5 * (3.0 * outer(axis, axis) - identity());
    CHECK(norm(sum + (2.0 * 0.7 * moment_anisotropy(5.0)) * order) < 1e-11);
    CHECK(std::fabs(trace(sum)) < 1e-11);
    CHECK(norm(sum - transpose(sum)) == 0.0);
    for (const int threads : {2, 3, 4}) {
        parallel::set_thread_count(threads);
        CHECK(sum_of_orientation_stresses(rods, 0.7).m == sum.m);
    }
}

// Theory, eq. (1.20): the mean is that over turning about one principal axis after another at its thermal speed. With W
// v = Omega x v, int rho (Omega x x)(Omega x x) = W N W^T, and int rho x (Omega x (Omega x x)) = N W W.
TEST_CASE("it is the momentum that a freely turning body carries, moving and by the forces that hold it together") {
    std::mt19937_64 generator(28);
    MESSAGE("seed 28");
    const double kT = 1.3;
    for (const double length : {0.0, 0.5, 2.0, 10.0}) {
        const auto moments = spherocylinder_moments(length, 0.8);
        const Vec3 axis = random_direction(generator);
        const Vec3 any = cross(axis, random_direction(generator)), across = any / norm(any);
        const Mat3 N = second_moment(moments, axis);
        Mat3 carried;
        const auto turn_about = [&](const Vec3& direction, double inertia) {
            const Vec3 omega = std::sqrt(kT / inertia) * direction;
            const Mat3 W = {{0, -omega.z, omega.y, omega.z, 0, -omega.x, -omega.y, omega.x, 0}};
            carried += W * N * transpose(W) + N * W * W;
        };
        turn_about(axis, moments.inertia_parallel());
        turn_about(across, moments.inertia_perpendicular());
        turn_about(cross(axis, across), moments.inertia_perpendicular());
        CHECK(norm(carried - orientation_stress_of_rod(axis, length, 0.8, kT)) < 1e-14);
    }
}
