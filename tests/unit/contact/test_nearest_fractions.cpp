#include <doctest/doctest.h>

#include "jostle/contact/nearest_fractions.hpp"

using namespace jostle;

TEST_CASE("crossing segments: fractions from end to end") {
    //  q from below to above p, at a height of 2:  p ----+-- ...
    const NearestFractions nearest = nearest_fractions({0, 0, 0}, {4, 0, 0}, {1, -1, 2}, {1, 3, 2});
    CHECK(nearest.distance == doctest::Approx(2.0).epsilon(1e-15));
    CHECK(nearest.s == doctest::Approx(0.25).epsilon(1e-15));
    CHECK(nearest.t == doctest::Approx(0.25).epsilon(1e-15));
}

TEST_CASE("fractions stay between 0 and 1, and the ends are reached exactly") {
    const NearestFractions before = nearest_fractions({1, 0, 0}, {1.1, 0, 0}, {-3, 0, 0}, {-2.7, 0, 0});
    CHECK(before.s == 0.0);
    CHECK(before.t == 1.0);
    const NearestFractions after = nearest_fractions({1, 0, 0}, {1.1, 0, 0}, {3, 0, 0}, {3.7, 0, 0});
    CHECK(after.s == 1.0);
    CHECK(after.t == 0.0);
}

TEST_CASE("a segment without length is a point, at one half") {
    const NearestFractions nearest = nearest_fractions({1, 2, 3}, {1, 2, 3}, {1, 2, 8}, {1, 2, 8});
    CHECK(nearest.distance == 5.0);
    CHECK(nearest.s == 0.5);
    CHECK(nearest.t == 0.5);
}
