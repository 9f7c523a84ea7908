#include <doctest/doctest.h>

#include <initializer_list>
#include <numbers>

#include "jostle/math/rotation.hpp"

using namespace jostle;

TEST_CASE("rotations by hand, at angles small and large") {
    const double pi = std::numbers::pi;
    struct Case {
        Vec3 axis, angle, expected;
    };
    for (const auto& [axis, angle, expected] : {
             Case{{1, 0, 0}, {0, 0, pi / 2}, {0, 1, 0}},
             Case{{1, 0, 0}, {0, 0, pi}, {-1, 0, 0}},
             Case{{1, 0, 0}, {0, 0, 2.0}, {std::cos(2.0), std::sin(2.0), 0}},
             Case{{0, 0, 1}, {0, 0, 3.0}, {0, 0, 1}},  // about itself
             Case{{0, 1, 0}, {1e-9, 0, 0}, {0, 1, 1e-9}},
             Case{{0, 1, 0}, {0, 0, 0}, {0, 1, 0}},
             // a third of a turn about (1, 1, 1) permutes the axes
             Case{{1, 0, 0}, (2.0 * pi / 3.0) * normalised({1, 1, 1}), {0, 1, 0}},
         })
        CHECK(norm(rotated(axis, angle) - expected) < 1e-15 * 10);
}

TEST_CASE("half a turn twice is a whole one, and the length stays 1 over many turns") {
    Vec3 axis = normalised({1, 2, 3});
    const Vec3 start = axis, angle{0.3, -0.2, 0.5};
    for (int k = 0; k < 100000; ++k) axis = rotated(axis, angle);
    CHECK(std::fabs(norm(axis) - 1.0) < 1e-15 * 4);
    for (int k = 0; k < 100000; ++k) axis = rotated(axis, -angle);
    CHECK(norm(axis - start) < 1e-9);
}

TEST_CASE("the rotation matrix of a quaternion turns as the rotation vector does, whatever its length") {
    const Vec3 angle{0.7, -1.1, 0.4}, unit = normalised(angle);
    const double half = 0.5 * norm(angle);
    for (const double length : {1.0, 0.01, -3.0}) {
        const Vec3 vector = length * std::sin(half) * unit;
        const Mat3 rotation = rotation_of_quaternion(length * std::cos(half), vector.x, vector.y, vector.z);
        for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
            CHECK(norm(rotation * axis - rotated(axis, angle)) < 1e-15 * 10);
        CHECK(norm(rotation * transpose(rotation) - identity()) < 1e-15 * 10);
    }
}

TEST_CASE("the axial vector of a dyad is the cross product") {
    const Vec3 a{1, 2, 3}, b{-2, 0.5, 4};
    CHECK(norm(axial_vector(outer(a, b)) - cross(a, b)) == 0.0);
    CHECK(norm(axial_vector(outer(a, a))) == 0.0);
}
