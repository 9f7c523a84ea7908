#include <doctest/doctest.h>

#include <limits>

#include "jostle/error/input_error.hpp"
#include "jostle/motion/self_propulsion.hpp"

using namespace jostle;

TEST_CASE("every rod, spheres too, gets the speed along its axis, added to what is known") {
    Rods rods;
    rods.push_back(0, {0, 0, 0}, {0, 0.6, 0.8}, 5.0, 1.0);
    rods.push_back(1, {0, 0, 0}, {-1, 0, 0}, 0.0, 1.0);
    Velocities known(2);
    known.linear[0] = {1, 1, 1};
    known.angular[1] = {0, 0, 7};
    SelfPropulsion(2.5).add_to(known, rods, {1, 1, 0.1});
    CHECK(norm(known.linear[0] - Vec3{1, 2.5, 3}) < 1e-15);
    CHECK(known.linear[1] == Vec3{-2.5, 0, 0});
    CHECK(known.angular[0] == Vec3{0, 0, 0});
    CHECK(known.angular[1] == Vec3{0, 0, 7});
    SelfPropulsion(-2.5).add_to(known, rods, {1, 1, 0.1});
    CHECK(known.linear[1] == Vec3{0, 0, 0});
}

TEST_CASE("a speed that is not finite is refused by key") {
    try {
        SelfPropulsion{std::numeric_limits<double>::infinity()};
        FAIL_CHECK("accepted an infinite speed");
    } catch (const InputError& error) {
        CHECK(error.parts().key == "motion.self_propulsion");
    }
}
