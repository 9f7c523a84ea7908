// A scene is right in any unit of length that its keys admit: scaled by a power of four it gives the same bits.

#include <doctest/doctest.h>

#include <cmath>

#include "jostle/scene/scene_keys.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"

using namespace jostle;

namespace {

/// Rods of diameter `unit`, crowded; kT and viscosity are such that times are the same in any unit, and square roots
/// exact for units of 4^k.
Simulation crowd(double unit) {
    Scene scene;
    scene.seed = 3;
    scene.box.edges = Vec3{7 * unit, 6 * unit, 6 * unit};
    scene.rods.count = 32;
    scene.rods.length = 2.0 * unit;
    scene.rods.diameter = unit;
    scene.fluid.kT = unit;
    scene.fluid.viscosity = 1.0 / (unit * unit);
    scene.time.rms_step = 0.05;
    const Box box{*scene.box.edges, {true, true, true}};
    return assemble(scene, {box, make_start(scene, box)});
}

}  // namespace

TEST_CASE("the smallest and the largest rods move as those of diameter 1 do, to the last bit") {
    Simulation one = crowd(1.0);
    Simulation small = crowd(0x1p-48), large = crowd(0x1p48);
    REQUIRE((0x1p-48 > Range::smallest_length && 0x1p48 < Range::largest_length));
    std::size_t contacts = 0;
    for (int step = 0; step < 300; ++step)
        for (Simulation* simulation : {&one, &small, &large}) contacts += simulation->step().active_contacts;
    CHECK(contacts > 900);
    for (std::size_t i = 0; i < one.rods().size(); ++i) {
        CHECK(0x1p48 * small.rods().centre[i] == one.rods().centre[i]);
        CHECK(0x1p-48 * large.rods().centre[i] == one.rods().centre[i]);
        CHECK(small.rods().axis[i] == one.rods().axis[i]);
        CHECK(large.rods().axis[i] == one.rods().axis[i]);
    }
}
