// Nematic order of sets whose order is known.

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "jostle/error/input_error.hpp"
#include "jostle/statistics/order_parameter.hpp"

using namespace jostle;

namespace {

std::vector<Vec3> isotropic(std::mt19937_64& generator, std::size_t count) {
    std::normal_distribution<double> normal;
    std::vector<Vec3> axes;
    for (std::size_t k = 0; k < count; ++k) {
        const double x = normal(generator), y = normal(generator), z = normal(generator);
        axes.push_back(normalised({x, y, z}));
    }
    return axes;
}

}  // namespace

TEST_CASE("aligned: S = 1 along the axis, whichever way heads point") {
    const Vec3 axis = normalised({1, -2, 2});
    std::vector<Vec3> axes;
    for (int k = 0; k < 100; ++k) axes.push_back(k % 3 == 0 ? -axis : axis);
    const NematicOrder found = nematic_order(axes);
    CHECK(found.order == doctest::Approx(1.0).epsilon(1e-12));
    CHECK(std::fabs(dot(found.director, axis)) == doctest::Approx(1.0).epsilon(1e-12));
    CHECK(std::fabs(trace(found.tensor)) < 1e-14);
    for (Vec3& one : axes) one = -one;
    CHECK(nematic_order(axes).tensor.m == found.tensor.m);
    CHECK(nematic_order(axes).director == found.director);
}

TEST_CASE("three axes at right angles: S = 0; evenly spread in a plane: S = 1/4, no eigenvalue above it") {
    const std::vector<Vec3> cube = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    CHECK(std::fabs(nematic_order(cube).order) < 1e-14);
    CHECK(norm(nematic_order(cube).tensor) < 1e-14);
    std::vector<Vec3> plane;
    for (int k = 0; k < 12; ++k) {
        const double angle = std::numbers::pi * k / 12.0;
        plane.push_back({std::cos(angle), 0.0, std::sin(angle)});
    }
    const NematicOrder found = nematic_order(plane);
    CHECK(found.order == doctest::Approx(0.25).epsilon(1e-12));
    CHECK(found.tensor(1, 1) == doctest::Approx(-0.5).epsilon(1e-12));
    CHECK(std::fabs(found.director.y) < 1e-12);
}

TEST_CASE("isotropic axes: every entry of Q within its sampling error of 0") {
    std::mt19937_64 generator(61);
    MESSAGE("seed 61");
    constexpr std::size_t count = 20000;
    const NematicOrder found = nematic_order(isotropic(generator, count));
    // (3 n_x^2 - 1)/2 has the variance 1/5, (3/2) n_x n_y the variance 3/20. Four deviations, six entries: false alarm
    // 4e-4.
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
            CHECK(std::fabs(found.tensor(a, b)) < 4.0 * std::sqrt((a == b ? 0.2 : 0.15) / count));
    CHECK(found.order > 0.0);
}

TEST_CASE("a cone about the director: S = (3 cos^2 - 1)/2") {
    std::vector<Vec3> axes;
    const double tilt = 0.4;
    for (int k = 0; k < 7; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / 7.0;
        axes.push_back({std::sin(tilt) * std::cos(angle), std::sin(tilt) * std::sin(angle), -std::cos(tilt)});
    }
    const NematicOrder found = nematic_order(axes);
    CHECK(found.order == doctest::Approx(1.5 * std::cos(tilt) * std::cos(tilt) - 0.5).epsilon(1e-12));
    CHECK(found.director.z == doctest::Approx(1.0).epsilon(1e-12));  // the largest component is made positive
}

TEST_CASE("no rods, no order") {
    CHECK_THROWS_AS(nematic_order({}), InputError);
}
