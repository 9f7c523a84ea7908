// Ramps: their values and means by hand, and what is refused of them.

#include <doctest/doctest.h>

#include <functional>
#include <string>

#include "jostle/error/input_error.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/scene/scene_mobility.hpp"
#include "jostle/scene/schedule.hpp"
#include "jostle/scene/step_limits.hpp"
#include "jostle/scene/time_step.hpp"
#include "jostle/scene/validate_scene.hpp"

using namespace jostle;

namespace {

//     4 |        .------
//     2 |----.  /
//     1 |     \/            at times 2, 3, 5
const Ramp<double> ramp = {{2.0, 2.0}, {3.0, 1.0}, {5.0, 4.0}};

Scene rods() {
    Scene scene;
    scene.box.volume_fraction = 0.1;
    scene.rods.count = 100;
    scene.rods.length = 3.0;
    scene.time.production = 10.0;
    return scene;
}

/// Key and problem of what is refused; empty where nothing is.
std::string refusal(const std::function<void(Scene&)>& change) {
    Scene scene = rods();
    change(scene);
    try {
        validate(scene);
    } catch (const InputError& error) {
        CHECK(error.parts().others.empty());
        return error.parts().key + " " + error.parts().problem;
    }
    return "";
}

bool begins(const std::string& text, const std::string& with) {
    CAPTURE(text);
    return text.starts_with(with);
}

double automatic_step(const Scene& scene) {
    Rods one;
    one.push_back(0, {}, {1, 0, 0}, scene.rods.length, scene.rods.diameter);
    return time_step(scene, *make_mobility(scene), {box_edges(scene), scene.box.periodic}, one, {});
}

}  // namespace

TEST_CASE("a ramp has the values of straight lines, and stays after the last point") {
    CHECK(value_at(2.0, ramp, 0.0) == 2.0);
    CHECK(value_at(2.0, ramp, 1.7) == 2.0);
    CHECK(value_at(2.0, ramp, 2.5) == doctest::Approx(1.5));
    CHECK(value_at(2.0, ramp, 4.0) == doctest::Approx(2.5));
    CHECK(value_at(2.0, ramp, 5.0) == 4.0);
    CHECK(value_at(2.0, ramp, 1e9) == 4.0);
    CHECK(value_at(Vec3{1, 2, 3}, Ramp<Vec3>{{4.0, {3, 2, 1}}}, 2.0) == Vec3{2, 2, 2});
}

TEST_CASE("means over a stretch of time are exact across points, and values to the bit where nothing changes") {
    CHECK(mean_over(2.0, ramp, 2.0, 3.0) == doctest::Approx(1.5));
    CHECK(mean_over(2.0, ramp, 1.0, 4.0) == doctest::Approx((2.0 + 1.5 + 1.75) / 3.0));
    CHECK(mean_over(2.0, ramp, 0.0, 10.0) == doctest::Approx((2 * 2.0 + 1.5 + 2 * 2.5 + 5 * 4.0) / 10.0));
    for (const double begin : {0.1, 0.7, 1.3})
        CHECK(mean_over(0.3, Ramp<double>{{2.0, 0.3}, {3.0, 1.0}}, begin, begin + 0.1) == 0.3);
    CHECK(mean_over(0.3, Ramp<double>{{2.0, 0.7}}, 2.1, 2.4) == 0.7);
}

TEST_CASE("a scene at a time has the values of its ramps, and its hardest the largest of each") {
    Scene scene = rods();
    scene.fluid.kT = 1.0;
    scene.schedule.kT = {{1.0, 3.0}, {2.0, 0.5}};
    scene.schedule.self_propulsion = {{4.0, 8.0}};
    CHECK(schedule_end(scene) == 4.0);
    CHECK(scene_at(scene, 0.5).fluid.kT == 2.0);
    CHECK(scene_at(scene, 0.5).motion.self_propulsion == 1.0);
    CHECK(scene_at_end(scene).fluid.kT == 0.5);
    CHECK(scene_during(scene, 0.5, 1.5).fluid.kT == doctest::Approx(0.5 * (2.5 + 2.375)));
    CHECK(scene_at_its_hardest(scene).fluid.kT == 3.0);
    CHECK(scene_at_its_hardest(scene).motion.self_propulsion == 8.0);
    CHECK(names_of_schedule(scene) == "schedule.self_propulsion, schedule.kT");
}

TEST_CASE("a volume fraction becomes edges of the same shape") {
    Scene scene = rods();
    scene.box.shape = {1, 2, 4};
    scene.schedule.volume_fraction = {{3.0, 0.3}};
    const double volume = rods_volume(scene);
    const Ramp<Vec3> edges = ramp_of_edges(scene, volume);
    REQUIRE(edges.size() == 1);
    const Vec3& last = edges[0].value;
    CHECK(volume / (last.x * last.y * last.z) == doctest::Approx(0.3).epsilon(1e-14));
    CHECK(last.y / last.x == doctest::Approx(2.0));
    CHECK(last.z / last.x == doctest::Approx(4.0));
    scene.box = {};
    scene.box.edges = Vec3{20, 10, 30};
    scene.box.periodic = {true, true, true};
    CHECK(ramp_of_edges(scene, volume)[0].value.x / ramp_of_edges(scene, volume)[0].value.y == doctest::Approx(2.0));
}

TEST_CASE("an automatic step is short enough for the hottest, the fastest and the quickest squeeze") {
    Scene scene = rods();
    const double plain = automatic_step(scene);
    scene.schedule.kT = {{5.0, 0.1}, {6.0, 4.0}};
    CHECK(automatic_step(scene) == doctest::Approx(plain / 4.0));
    scene.schedule.kT = {{5.0, 0.1}};
    CHECK(automatic_step(scene) == plain);
    scene.schedule.self_propulsion = {{5.0, 1000.0}};
    CHECK(automatic_step(scene) == doctest::Approx(0.04 / 1000.0));  // 0.04 D a step
    scene.schedule = {};
    scene.motion.brownian = false;
    scene.box = {};
    scene.box.edges = Vec3{40, 40, 40};
    scene.box.periodic = {true, true, true};
    scene.schedule.edges = {{2.0, {20, 20, 20}}};
    // edges lose 10 a time of 20 at the end: rods of 4 D, end to end, come nearer by 0.01 D in a step of 0.005
    CHECK(automatic_step(scene) == doctest::Approx(0.005));
}

TEST_CASE("bad schedules: one problem each, and the key that has it") {
    CHECK(refusal([](Scene& s) { s.schedule.kT = {{1.0, 2.0}, {3.0, 0.0}}; }) == "");
    CHECK(refusal([](Scene& s) { s.schedule.volume_fraction = {{1.0, 0.5}}; }) == "");
    CHECK(begins(refusal([](Scene& s) { s.schedule.kT = {{2.0, 1.0}, {2.0, 0.5}}; }), "schedule.kT is no later"));
    CHECK(begins(refusal([](Scene& s) { s.schedule.kT = {{3.0, 1.0}, {2.0, 0.5}}; }), "schedule.kT is no later"));
    CHECK(begins(refusal([](Scene& s) { s.schedule.kT = {{0.0, 1.0}}; }), "schedule.kT is no time after 0"));
    CHECK(begins(refusal([](Scene& s) { s.schedule.kT = {{1.0, -1.0}}; }), "schedule.kT is negative"));
    CHECK(begins(refusal([](Scene& s) {
                     s.schedule.self_propulsion = {{1.0, NAN}};
                 }),
                 "schedule.self_propulsion is not"));
    CHECK(begins(refusal([](Scene& s) {
                     s.motion.brownian = false;
                     s.motion.self_propulsion = 1.0;
                     s.schedule.kT = {{1.0, 2.0}};
                 }),
                 "schedule.kT is not used with motion.brownian = false"));
    CHECK(begins(refusal([](Scene& s) {
                     s.schedule.edges = {{1.0, {20, 20, 20}}};
                     s.schedule.volume_fraction = {{1.0, 0.3}};
                 }),
                 "schedule.edges is given beside"));
    CHECK(begins(refusal([](Scene& s) {
                     s.schedule.volume_fraction = {{1.0, 0.9}};
                 }),
                 "schedule.volume_fraction cannot be packed at time 1"));
    CHECK(begins(refusal([](Scene& s) {
                     s.schedule.edges = {{1.0, {0.5, 900, 900}}};
                 }),
                 "schedule.edges makes the box thinner than a rod's diameter"));
    CHECK(begins(refusal([](Scene& s) {
                     s.box.periodic = {true, true, false};
                     s.schedule.volume_fraction = {{1.0, 0.3}};
                 }),
                 "schedule.volume_fraction changes edge z, along which the box is open"));
    CHECK(refusal([](Scene& s) {
              s.box = {};
              s.box.edges = Vec3{20, 20, 20};
              s.box.periodic = {true, true, false};
              s.schedule.edges = {{1.0, {18, 18, 20}}};
          }) == "");
    CHECK(begins(refusal([](Scene& s) {
                     s.growth.rate = 1.0;
                     s.growth.division_length = 7.0;
                     s.schedule.volume_fraction = {{1.0, 0.3}};
                 }),
                 "schedule.volume_fraction changes the box, and with growth.rate"));
}

TEST_CASE("a step that is too long for a schedule is refused") {
    CHECK(begins(refusal([](Scene& s) {
                     s.time.step = 0.01;
                     s.schedule.self_propulsion = {{1.0, 100.0}};
                 }),
                 "motion.self_propulsion takes a rod through others"));
}
