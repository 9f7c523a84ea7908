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
