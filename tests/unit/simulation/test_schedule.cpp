// Steps under a schedule: free rods by formulas, a box that is squeezed, and the same bits however the steps are made.

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "jostle/setup/assemble.hpp"
#include "support/assemblies.hpp"
#include "support/simulations.hpp"

using namespace jostle;
using test::check_same_state;
using test::places;
using test::started;

namespace {

Scene dilute(std::uint64_t count) {
    Scene scene;
    scene.seed = 17;
    scene.box.volume_fraction = 1e-9;  // no rod meets another
    scene.rods.count = count;
    scene.rods.length = 3.0;
    scene.time.step = 0.01;
    return scene;
}

/// 60 rods, squeezed within 150 steps while they are heated and begin to swim.
Scene squeezed() {
    Scene scene;
    scene.seed = 8;
    scene.box.volume_fraction = 0.15;
    scene.rods.count = 60;
    scene.rods.length = 2.0;
    scene.time.step = 0.004;
    scene.schedule.volume_fraction = {{0.6, 0.45}};
    scene.schedule.kT = {{0.3, 2.0}, {0.5, 1.0}};
    scene.schedule.self_propulsion = {{0.1, 0.0}, {0.7, 5.0}};
    return scene;
}

}  // namespace

TEST_CASE("a swimmer whose speed is ramped comes as far as the integral of the speed, wherever the points lie") {
    Scene scene = dilute(5);
    scene.motion.brownian = false;
    scene.motion.self_propulsion = 1.0;
    scene.schedule.self_propulsion = {{0.333, 4.0}, {0.8017, 0.5}};  // in the middle of steps
    Simulation simulation = started(scene);
    const auto before = places(simulation);
    for (int step = 0; step < 100; ++step) REQUIRE(simulation.step().status == LcpStatus::converged);
    const double path = 0.333 * 2.5 + (0.8017 - 0.333) * 2.25 + (1.0 - 0.8017) * 0.5;
    const auto after = places(simulation);
    for (std::size_t k = 0; k < after.size(); ++k)
        CHECK(norm(after[k] - before[k]) == doctest::Approx(path).epsilon(1e-11));
}

// Mean square displacement of free rods: 2 (mu_parallel + 2 mu_perpendicular) times the integral of kT, exact for any
// time step. Five standard errors of the sample: false-alarm rate 5.7e-7 a seed.
TEST_CASE("free rods whose kT is ramped diffuse as the integral of kT says") {
    Scene scene = dilute(6000);
    scene.fluid.kT = 0.5;
    scene.schedule.kT = {{0.1, 0.0}, {0.25, 0.0}, {0.4, 3.0}};
    scene.time.step = 0.02;
    Simulation simulation = started(scene);
    const auto before = places(simulation);
    for (int step = 0; step < 30; ++step) REQUIRE(simulation.step().status == LcpStatus::converged);
    CHECK(simulation.settings().kT == 3.0);
    const double integral = 0.1 * 0.25 + 0.15 * 1.5 + 0.2 * 3.0;  // to time 0.6
    const RodMobility rod = simulation.mobility().at(simulation.rods(), simulation.box())->of_rod(0);
    const double expected = 2.0 * (rod.parallel + 2.0 * rod.perpendicular) * integral;
    const auto after = places(simulation);
    double sum = 0.0, squares = 0.0;
    for (std::size_t k = 0; k < after.size(); ++k) {
        const double square = squared_norm(after[k] - before[k]);
        sum += square;
        squares += square * square;
    }
    const auto count = static_cast<double>(after.size());
    const double mean = sum / count, error = std::sqrt((squares / count - mean * mean) / count);
    MESSAGE("mean square displacement ", mean, " +- ", error, ", expected ", expected);
    CHECK(std::fabs(mean - expected) < 5.0 * error);
    CHECK(error < 0.02 * expected);
}

TEST_CASE("a box that is squeezed takes the centres with it") {
    Scene scene = dilute(200);
    scene.motion.brownian = false;
    scene.schedule.edges = {{0.5, {900, 1000, 1100}}, {1.0, {1000, 900, 800}}};
    scene.time.step = 0.005;
    scene.box = {};
    scene.box.edges = Vec3{1000, 1000, 1000};
    scene.box.periodic = {true, true, true};
    Simulation simulation = started(scene);
    const auto before = places(simulation);
    for (int step = 0; step < 100; ++step) {
        const StepReport report = simulation.step();
        REQUIRE(report.status == LcpStatus::converged);
        CHECK(report.stretch.x < 1.0);
        CHECK(report.stretch.y == 1.0);
    }
    CHECK(simulation.box().edges() == Vec3{900, 1000, 1100});
    for (int step = 0; step < 150; ++step) REQUIRE(simulation.step().status == LcpStatus::converged);
    CHECK(simulation.box().edges() == Vec3{1000, 900, 800});
    CHECK(simulation.step().stretch == Vec3{1, 1, 1});
    const auto after = places(simulation);
    for (std::size_t k = 0; k < after.size(); ++k)
        CHECK(norm(after[k] - Vec3{before[k].x, 0.9 * before[k].y, 0.8 * before[k].z}) < 1e-9);
}

TEST_CASE("squeezed rods have the volume fraction of the schedule, and do not overlap") {
    const Scene scene = squeezed();
    Simulation simulation = started(scene);
    double largest = 0.0;
    for (int step = 0; step < 200; ++step) {
        const StepReport report = simulation.step();
        REQUIRE(report.status == LcpStatus::converged);
        largest = std::max(largest, report.max_overlap);
    }
    CHECK(total_volume(simulation.rods()) / simulation.box().volume() == doctest::Approx(0.45).epsilon(1e-14));
    double now = 0.0;
    for (const auto& pair : test::brute_force_pairs(simulation.rods(), simulation.box(), 0.0))
        now = std::max(now, -pair.gap);
    MESSAGE("largest overlap ", largest, " D on the way, ", now, " D at the end");
    CHECK(std::max(largest, now) < 0.06);  // contacts are compliant: some hundredths of D at this step
}

TEST_CASE("a simulation made anew in every step makes the same step: state, clock and scene tell all of a schedule") {
    const Scene scene = squeezed();
    Simulation whole = started(scene);
    for (int step = 0; step < 190; ++step) {
        Simulation anew = assemble(scene, whole.state());
        CHECK(anew.settings().time_step == whole.settings().time_step);
        const StepReport a = whole.step(), b = anew.step();
        REQUIRE(a.status == LcpStatus::converged);
        CHECK(a.collision_virial.m == b.collision_virial.m);
        CHECK(a.max_overlap == b.max_overlap);
        CHECK(whole.settings().kT == anew.settings().kT);
        CHECK(assemble(scene, whole.state()).settings().kT == whole.settings().kT);
        check_same_state(whole, anew);
    }
}

TEST_CASE("an automatic step is the same wherever the run goes on") {
    Scene scene = squeezed();
    scene.time.step.reset();
    scene.rods.length = 6.0;
    scene.schedule.volume_fraction = {{0.3, 0.05}, {0.6, 0.3}};
    Simulation simulation = started(scene);
    const double step = simulation.settings().time_step;
    for (int k = 0; k < 40; ++k) {
        REQUIRE(simulation.step().status == LcpStatus::converged);
        CHECK(assemble(scene, simulation.state()).settings().time_step == step);
    }
}

TEST_CASE("a step that is not made leaves the box and the centres as they were") {
    const Scene scene = squeezed();
    Simulation simulation = started(scene), other = started(scene);
    for (int step = 0; step < 150; ++step) {
        REQUIRE(simulation.step().status == LcpStatus::converged);
        REQUIRE(other.step().status == LcpStatus::converged);
    }
    bool stop = true;
    simulation.interrupt_when([&] { return stop; });
    REQUIRE(simulation.step().status == LcpStatus::interrupted);
    check_same_state(simulation, other);
    stop = false;
    REQUIRE(simulation.step().status == LcpStatus::converged);
    REQUIRE(other.step().status == LcpStatus::converged);
    check_same_state(simulation, other);
}

TEST_CASE("motions that were added stay beside those of a schedule") {
    struct Wind final : Motion {
        void add_velocities(Velocities& known, const Rods& rods, const MobilityOperator&,
                            const StepContext&) const override {
            for (std::size_t i = 0; i < rods.size(); ++i) known.linear[i].x += 3.0;
        }
    };
    Scene scene = dilute(3);
    scene.fluid.kT = 0.0;
    scene.schedule.kT = {{1e3, 1e-30}};
    Simulation simulation = started(scene);
    simulation.add(std::make_unique<Wind>());
    const auto before = places(simulation);
    for (int step = 0; step < 20; ++step) REQUIRE(simulation.step().status == LcpStatus::converged);
    const auto after = places(simulation);
    for (std::size_t k = 0; k < after.size(); ++k)
        CHECK(after[k].x - before[k].x == doctest::Approx(0.6).epsilon(1e-9));
}
