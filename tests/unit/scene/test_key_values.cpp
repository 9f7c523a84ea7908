#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "jostle/scene/key_values.hpp"

using namespace jostle;

namespace {

Scene some_scene() {
    Scene scene;
    scene.box.volume_fraction = 0.2;
    scene.rods.count = 100;
    scene.rods.length = 5.0;
    scene.time.rms_step = 0.03;
    scene.time.production = 100.0;
    scene.output.trajectory_every = 0;
    return scene;
}

std::string difference(const std::function<void(Scene&)>& change) {
    Scene now = some_scene();
    change(now);
    return physics_difference(some_scene(), now);
}

}  // namespace

TEST_CASE("keys that are physics are compared by their values") {
    CHECK(difference([](Scene&) {}) == "");
    CHECK(difference([](Scene& now) { now.rods.length = 6.0; }) == "rods.length was 5 and is 6");
    CHECK(difference([](Scene& now) { now.seed = 2; }) == "seed was 1 and is 2");
    CHECK(difference([](Scene& now) { now.rods.length = std::nextafter(5.0, 6.0); }) ==
          "rods.length was 5 and is 5.000000000000001");
    CHECK(difference([](Scene& now) { now.box.shape.y = 1.0 + 1e-12; }) ==
          "box.shape was [1, 1, 1] and is [1, 1.000000000001, 1]");
    CHECK(difference([](Scene& now) { now.box.periodic[2] = false; }) ==
          "box.periodic was [true, true, true] and is [true, true, false]");
    CHECK(difference([](Scene& now) { now.solver.method = SolverMethod::apgd; }) ==
          "solver.method was auto and is apgd");
    CHECK(difference([](Scene& now) { now.output.series_every = 20; }) == "output.series_every was 10 and is 20");
    CHECK(difference([](Scene& now) {
              now.box.volume_fraction.reset();
              now.box.edges = Vec3{9, 9, 9};
          }) == "box.volume_fraction was 0.2 and is auto, and 1 other key differs");
    CHECK(difference([](Scene& now) {
              now.seed = 2;
              now.fluid.kT = 2.0;
              now.fluid.viscosity = 2.0;
          }) == "seed was 1 and is 2, and 2 other keys differ");
}

TEST_CASE("keys that are no physics may change") {
    CHECK(difference([](Scene& now) {
              now.title = "another";
              now.contact.overlap_limit = 0.5;
              now.solver.max_iterations = 7;
              now.time.equilibration = 3.0;
              now.time.production = 200.0;
              now.output.trajectory_every = 10;
              now.output.stress_per_rod = true;  // means nothing without frames
              now.output.checkpoint_every = 3;
              now.output.contacts = true;
              now.output.field_every = 5;
              now.output.field_spacing = 2.0;  // means nothing without fields
          }) == "");
}

TEST_CASE("what one of two scenes does not use does not count") {
    Scene before = some_scene(), now = some_scene();
    before.output.field_every = now.output.field_every = 10;
    now.output.field_spacing = 3.0;
    CHECK(physics_difference(before, now) == "output.field_spacing was auto and is 3");
    now.output.field_every = 0;
    CHECK(physics_difference(before, now) == "");
}
