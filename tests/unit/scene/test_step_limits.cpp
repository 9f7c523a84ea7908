#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "jostle/scene/scene_mobility.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/step_limits.hpp"
#include "jostle/scene/time_step.hpp"

using namespace jostle;

namespace {

const Box box{{20, 20, 20}, {true, true, true}};

/// Two rods: L/D = 4, and a sphere half as thick.
Rods two_rods() {
    Rods rods;
    rods.push_back(0, {5, 5, 5}, {1, 0, 0}, 4.0, 1.0);
    rods.push_back(1, {9, 9, 9}, {1, 0, 0}, 0.0, 0.5);
    return rods;
}

Scene swimmers() {
    Scene scene;
    scene.rods.count = 2;
    scene.rods.length = 4.0;
    scene.motion.self_propulsion = 0.5;
    scene.motion.tumble_rate = 2.0;
    return scene;
}

const StepLimit& limit_of(const std::vector<StepLimit>& limits, std::string_view key) {
    const auto found =
        std::find_if(limits.begin(), limits.end(), [&](const StepLimit& limit) { return limit.key == key; });
    REQUIRE(found != limits.end());
    return *found;
}

}  // namespace

TEST_CASE("noise keeps equilibrium; swimming and growth do not, nor is there any without noise") {
    Scene scene;
    CHECK(keeps_equilibrium(scene));
    CHECK(motions_of(scene).size() == 1);
    CHECK(motions_of(scene)[0]->keeps_equilibrium());
    CHECK(!keeps_equilibrium(swimmers()));
    CHECK(!motions_of(swimmers())[1]->keeps_equilibrium());
    Scene still = scene;
    still.motion.brownian = false;
    CHECK(!keeps_equilibrium(still));
    CHECK(motions_of(still).empty());
    scene.growth.rate = 0.1;
    CHECK(!keeps_equilibrium(scene));
}

TEST_CASE("each motion says how much happens in a step, of the rods that it is most for") {
    const Rods rods = two_rods();
    const Scene scene = swimmers();
    const auto model = make_mobility(scene);
    const auto limits = step_limits(scene, *model, box, rods);
    const double dt = 0.01;
    const RodMobility sphere = model->at(rods, box)->of_rod(1);
    CHECK(limit_of(limits, "fluid.kT").amount(dt) == doctest::Approx(std::sqrt(2.0 * sphere.parallel * dt) / 0.5));
    CHECK(limit_of(limits, "motion.self_propulsion").amount(dt) == doctest::Approx(0.5 * dt / 0.5));
    CHECK(limit_of(limits, "motion.tumble_rate").amount(dt) == doctest::Approx(2.0 * dt));
    // A tumble takes 0.05 and turns an end that is 2 from the centre by up to pi.
    CHECK(limit_of(limits, "motion.tumble_time").amount(dt) == doctest::Approx(std::numbers::pi * 2.0 * dt / 0.05));
    for (const StepLimit& limit : limits) CHECK(limit.step_of(limit.amount(dt)) == doctest::Approx(dt));
}

TEST_CASE("the automatic step is the longest at which each limit has at most its automatic amount") {
    const Rods rods = two_rods();
    const Scene scene = swimmers();
    const auto model = make_mobility(scene);
    const auto limits = step_limits(scene, *model, box, rods);
    const double step = time_step(scene, *model, box, rods);
    double fullest = 0.0;
    for (const StepLimit& limit : limits) fullest = std::max(fullest, limit.amount(step) / limit.automatic);
    CHECK(fullest == doctest::Approx(1.0));
    CHECK(warnings_of_step(limits, step).empty());
    require_short_step(limits, step);
}

TEST_CASE("without other limits, to the last bit the step of rms_step = 0.04") {
    const Rods rods = two_rods();
    Scene scene, given;
    given.time.rms_step = 0.04;
    const auto model = make_mobility(scene);
    CHECK(time_step(scene, *model, box, rods) == time_step(given, *model, box, rods));
}

TEST_CASE("of cells that grow the automatic step does not depend on which of them live") {
    Scene scene = swimmers();
    scene.growth.rate = 0.1;
    scene.growth.division_length = 6.0;
    const auto model = make_mobility(scene);
    Rods one;
    one.push_back(7, {5, 5, 5}, {1, 0, 0}, 5.5, 1.0);
    CHECK(time_step(scene, *model, box, two_rods()) == time_step(scene, *model, box, one));
    CHECK(warnings_of_step(step_limits(scene, *model, box, one), time_step(scene, *model, box, one)).empty());
}
