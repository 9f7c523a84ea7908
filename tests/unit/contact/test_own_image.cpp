// How far a rod may be inclined between its own images, and how far these have to be: each is the inverse of the other,
// and at that inclination the rod touches its image.

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "jostle/contact/own_image.hpp"

using namespace jostle;

namespace {

/// Of a rod, inclined so far from side by side, and its image along x.
double gap_to_image(double apart, double inclination, double length, double diameter) {
    PairGeometry pair;
    pair.centre_separation = {apart, 0, 0};
    pair.axis_i = pair.axis_j = {std::sin(inclination), std::cos(inclination), 0};
    pair.half_i = pair.half_j = 0.5 * length;
    pair.radii = diameter;
    return pair_gap(pair);
}

}  // namespace

TEST_CASE("distance and inclination are inverse to each other, and there a rod touches its image") {
    for (const double length : {0.1, 1.0, 5.0})
        for (const double diameter : {0.5, 1.0, 2.0})
            for (const double inclination : {0.01, 0.3, 0.8, 1.2, 1.5}) {
                CAPTURE(length);
                CAPTURE(diameter);
                CAPTURE(inclination);
                const double apart = distance_between_images(inclination, length, diameter);
                CHECK(inclination_between_images(apart, length, diameter) == doctest::Approx(inclination));
                CHECK(gap_to_image(apart, inclination, length, diameter) == doctest::Approx(0.0).epsilon(1e-12));
            }
}

TEST_CASE("a rod that turns round needs its whole length, and a sphere its diameter") {
    CHECK(distance_between_images(0.5 * std::numbers::pi, 4.0, 1.5) == 5.5);
    CHECK(distance_between_images(7.0, 4.0, 1.5) == 5.5);
    CHECK(distance_between_images(0.7, 0.0, 1.5) == 1.5);
    CHECK(distance_between_images(0.0, 4.0, 1.5) == 1.5);
}
