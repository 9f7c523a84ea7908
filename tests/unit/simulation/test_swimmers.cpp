// Swimmers in a crowd: bodies stay hard, and nothing but the state decides.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "jostle/contact/pair_contacts.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/rods/space_filling_order.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/step_limits.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"
#include "support/assemblies.hpp"

using namespace jostle;

namespace {

const Box box{{8, 8, 8}, {true, true, true}};

/// 40 rods that swim, tumble often and turn round in every few steps, at volume fraction 0.16.
Scene crowd() {
    Scene scene;
    scene.seed = 3;
    scene.rods.count = 40;
    scene.rods.length = 2.0;
    scene.time.step = 0.005;
    scene.motion = {true, 2.0, 0.5, 5.0, 0.2, 20.0};
    return scene;
}

std::string refused_key(const Scene& scene) {
    try {
        const Rods rods = make_start(crowd(), box);
        require_short_step(step_limits(scene, *make_mobility(scene), box, rods), *scene.time.step);
    } catch (const InputError& error) {
        CHECK(!error.parts().allowed.empty());
        return error.parts().key;
    }
    return "";
}

}  // namespace

TEST_CASE("a rod that is turned far in one step does not end up inside another") {
    //           | 2        swims down by 2 D in one step, and turns 1 about its lower end,
    //       .-' v          until the upper one comes to lie on 0,
    //   .-'     1          where they did not touch before
    //   ========= 0
    Scene scene;
    scene.motion.brownian = false;
    scene.motion.self_propulsion = 2.0;
    scene.time.step = 1.0;
    const double sine = 0.35, cosine = std::sqrt(1.0 - sine * sine);
    Rods rods;
    rods.push_back(0, {10, 10, 10}, {1, 0, 0}, 4.0, 1.0);
    rods.push_back(1, {8.2 + 2.0 * cosine, 10, 11 + 2.0 * sine}, {cosine, 0, sine}, 4.0, 1.0);
    rods.push_back(2, {11.5, 10, 14.3}, {0, 0, -1}, 2.0, 1.0);
    rods.speed = {0.0, 0.0, 2.0};
    Simulation simulation = assemble(scene, {{{20, 20, 20}, {true, true, true}}, rods});
    const StepReport report = simulation.step();
    CHECK(report.status == LcpStatus::converged);
    CHECK(report.solves > 1);  // without another look: one solution, and an overlap of 1 D
    const Rods after = in_order_of_ids(simulation.rods());
    MESSAGE("solutions ", report.solves, ", gaps ", pair_gap(pair_geometry(after, 0, 1, {}, after.centre, after.axis)),
            " ", pair_gap(pair_geometry(after, 1, 2, {}, after.centre, after.axis)), ", turned to ", after.axis[1].z);
    for (const auto& [i, j] : {std::pair{0, 1}, {1, 2}})
        CHECK(pair_gap(pair_geometry(after, i, j, {}, after.centre, after.axis)) > -0.01 - 1e-5);
}

TEST_CASE("two rods head-on: they stop at touching, and push with U_0/mu_parallel") {
    //  ====> <====   U_0 = 2, dt = 0.01, kT = 0
    Scene scene;
    scene.motion.brownian = false;
    scene.motion.self_propulsion = 2.0;
    scene.time.step = 0.01;
    Rods rods;
    rods.push_back(0, {2, 5, 5}, {1, 0, 0}, 3.0, 1.0);
    rods.push_back(1, {6.03, 5, 5}, {-1, 0, 0}, 3.0, 1.0);
    const Box wide{{20, 20, 20}, {true, true, true}};
    Simulation simulation = assemble(scene, {wide, rods});
    for (int step = 0; step < 3; ++step) REQUIRE(simulation.step().status == LcpStatus::converged);
    const StepReport report = simulation.step();
    const double force = 2.0 / simulation.mobility().at(simulation.rods(), simulation.box())->of_rod(0).parallel;
    CHECK(simulation.rods().centre[1].x - simulation.rods().centre[0].x == doctest::Approx(4.0).epsilon(1e-5));
    double sum = 0.0;
    for (const double gamma : simulation.contact_solution().gamma) sum += gamma;
    CHECK(sum == doctest::Approx(force).epsilon(1e-3));
    CHECK(report.collision_virial(0, 0) == doctest::Approx(4.0 * force).epsilon(1e-3));
    const SelfPropulsion propulsion(2.0);
    const auto mobility = simulation.mobility().at(simulation.rods(), simulation.box());
    const auto forces = propulsion.propulsion(simulation.rods(), *mobility, {1, 4, 0.01});
    CHECK(norm(forces[0] - Vec3{force, 0, 0}) < 1e-12 * force);
    CHECK(norm(forces[1] + Vec3{force, 0, 0}) < 1e-12 * force);
}

TEST_CASE("rods that tumble and turn round do not overlap, against brute force") {
    const Scene scene = crowd();
    Simulation simulation = assemble(scene, {box, make_start(scene, box)});
    double largest = 0.0;
    for (int step = 0; step < 400; ++step) {
        REQUIRE(simulation.step().status == LcpStatus::converged);
        if (step % 10 != 9) continue;
        for (const auto& pair : test::brute_force_pairs(simulation.rods(), box, 0.0))
            largest = std::max(largest, -pair.gap);
    }
    MESSAGE("largest overlap ", largest, " D");
    CHECK(largest < 0.04);  // some hundredths of D, as for swimmers without tumbles (theory, section 3)
}

TEST_CASE("a simulation made anew in every step makes the same step: axes that flip fool no neighbour list") {
    const Scene scene = crowd();
    Simulation whole = assemble(scene, {box, make_start(scene, box)});
    std::size_t flips = 0, contacts = 0;
    for (int step = 0; step < 200; ++step) {
        Simulation anew = assemble(scene, whole.state());
        const StepReport a = whole.step(), b = anew.step();
        REQUIRE(a.status == LcpStatus::converged);
        CHECK(a.collision_virial.m == b.collision_virial.m);
        CHECK(a.active_contacts == b.active_contacts);
        const Rods rods = in_order_of_ids(whole.rods()), made_anew = in_order_of_ids(anew.rods());
        CHECK(rods.centre == made_anew.centre);
        CHECK(rods.axis == made_anew.axis);
        contacts += a.active_contacts;
        flips +=
            SelfPropulsion(swimming_of(scene)).turned_round(whole.rods(), {3, whole.clock().step - 1, 0.005}).size();
    }
    CHECK(flips > 400);
    CHECK(contacts > 1000);
}

TEST_CASE("tumbles too fast for the time step are refused by key") {
    CHECK(refused_key(crowd()) == "");
    Scene scene = crowd();
    scene.motion.tumble_time = 0.05;  // ten steps: the ends of a rod L/D = 2 would move by up to pi/10 D
    CHECK(refused_key(scene) == "motion.tumble_time");
    scene.motion.tumble_time.reset();  // 0.1/rate = 0.02
    CHECK(refused_key(scene) == "motion.tumble_time");
    scene.motion.tumble_time = 0.01;
    scene.motion.tumble_rate = 201.0;
    CHECK(refused_key(scene) == "motion.tumble_rate");
}

TEST_CASE("tumbles of growing cells are judged at the length that these reach") {
    Scene scene = crowd();
    scene.growth.rate = 0.01;
    scene.growth.division_length = 6.0;  // forty steps: the ends move by up to 0.236 D
    CHECK(refused_key(scene) == "");
    scene.growth.division_length = 7.0;  // 0.275 D
    CHECK(refused_key(scene) == "motion.tumble_time");
}

TEST_CASE("persistence time and lag of the active stress") {
    Scene scene = crowd();
    const Rods rods = make_start(scene, box);
    const auto model = make_mobility(scene);
    const auto mobility = model->at(rods, box);
    const double D_R = mobility->of_rod(0).rotational;
    const double time = 1.0 / (2.0 * D_R + 5.0 + 40.0);
    CHECK(persistence_time(scene, *mobility, rods.size()) == doctest::Approx(time));
    CHECK(active_stress_lag(scene, *mobility, rods.size()) == doctest::Approx(5.0 * time));
    scene.motion = {};
    scene.motion.brownian = false;
    scene.motion.self_propulsion = 2.0;
    scene.time.production = 30.0;
    CHECK(std::isinf(persistence_time(scene, *mobility, rods.size())));
    CHECK(active_stress_lag(scene, *mobility, rods.size()) == doctest::Approx(3.0));
    scene.output.active_stress_lag = 7.0;
    CHECK(active_stress_lag(scene, *mobility, rods.size()) == 7.0);
}
