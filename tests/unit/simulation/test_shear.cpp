// Steps in a shear flow: Jeffery's orbits, copies that slide past, and the same bits however the steps are made.

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "jostle/error/input_error.hpp"
#include "jostle/math/shear_rotation.hpp"
#include "jostle/rods/space_filling_order.hpp"
#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/largest_overlap.hpp"
#include "jostle/setup/start.hpp"
#include "jostle/stress/spherocylinder_moments.hpp"
#include "support/simulations.hpp"

using namespace jostle;
using test::box_at_start;
using test::check_same_state;
using test::make_steps;
using test::places;
using test::started;

namespace {

/// 60 rods at volume fraction 0.35, sheared fast: the copies slide by a whole edge every 200 steps.
Scene crowd() {
    Scene scene;
    scene.seed = 5;
    scene.box.volume_fraction = 0.35;
    scene.rods.count = 60;
    scene.rods.length = 1.0;
    scene.time.step = 0.002;
    scene.flow.shear_rate = 2.5;
    return scene;
}

}  // namespace

TEST_CASE("an axis in a shear flow comes round in Jeffery's period, in steps of any size, and keeps its orbit") {
    struct Case {
        double aspect_ratio, effective, period;
    };
    // r_e = sqrt(N_par/N_perp); period times rate = 2 pi (r_e + 1/r_e)
    for (const auto& [aspect_ratio, effective, period] :
         {Case{2.0, 3.195391, 22.0435637}, Case{5.0, 6.638696, 42.6586080}, Case{10.0, 12.4035520, 78.4403788}})
        for (const int steps : {7, 1000, 12345}) {
            const double lambda = moment_anisotropy(aspect_ratio);
            CHECK(std::sqrt((1.0 + lambda) / (1.0 - lambda)) == doctest::Approx(effective).epsilon(1e-6));
            const double whole = 2.0 * std::numbers::pi * 2.0 / std::sqrt((1.0 - lambda) * (1.0 + lambda));
            CHECK(whole == doctest::Approx(period).epsilon(1e-8));
            const Vec3 start = normalised({0.3, 0.5, -0.8});
            const ShearRotation step(whole / steps, lambda);
            Vec3 axis = start;
            // constant of an orbit: (n_x^2/r_e^2 + n_y^2)/n_z^2
            const auto orbit = [&](const Vec3& n) {
                return (n.x * n.x * (1.0 - lambda) / (1.0 + lambda) + n.y * n.y) / (n.z * n.z);
            };
            for (int k = 0; k < steps; ++k) {
                axis = step.of(axis);
                REQUIRE(orbit(axis) == doctest::Approx(orbit(start)).epsilon(1e-10));
            }
            CHECK(norm(axis - start) < 1e-11 * steps);
            CHECK(norm(axis - start) < 1e-9);
        }
}

TEST_CASE("for a small strain an axis turns as Jeffery's equation has it") {
    const double lambda = 0.9, strain = 1e-6;
    const Vec3 n = normalised({0.4, -0.7, 0.2});
    const Vec3 Kn = {0.5 * (1.0 + lambda) * n.y, -0.5 * (1.0 - lambda) * n.x, 0.0};
    const Vec3 expected = Kn - dot(n, Kn) * n;
    const Vec3 turned = ShearRotation(strain, lambda).of(n);
    CHECK(norm((turned - n) / strain - expected) < 2e-6);
    CHECK(norm(ShearRotation(0.1, 0.0).of({0, 0, 1}) - Vec3{0, 0, 1}) == 0.0);
}

TEST_CASE("a rod without noise goes with the flow, through faces and whole edges of the box, and turns by Jeffery") {
    Scene scene;
    scene.box.edges = Vec3{20, 12, 20};
    scene.rods.count = 1;
    scene.rods.length = 5.0;
    scene.motion.brownian = false;
    scene.flow.shear_rate = 1.0;
    const double period = 42.6586080;
    constexpr int steps = 5000;
    scene.time.step = period / steps;
    Simulation simulation = started(scene);
    const Vec3 before = places(simulation)[0], axis = simulation.rods().axis[0];
    int jumps = 0;
    double offset = 0.0;
    for (int step = 0; step < steps; ++step) {
        REQUIRE(simulation.step().status == LcpStatus::converged);
        jumps += std::fabs(simulation.box().offset() - offset) > 10.0 ? 1 : 0;
        offset = simulation.box().offset();
    }
    CHECK(jumps == 26);  // the period times 12/20, rounded
    const Vec3 after = places(simulation)[0];
    CHECK(norm(after - before - Vec3{period * before.y, 0, 0}) < 1e-9);
    CHECK(norm(simulation.rods().axis[0] - axis) < 1e-7);  // by the digits of the period
    CHECK(offset == doctest::Approx(std::remainder(period * 12, 20.0)).epsilon(1e-9));
}

TEST_CASE("two rods far apart across the faces along y stay apart as the flow has them") {
    Scene scene;
    scene.box.edges = Vec3{20, 12, 20};
    scene.rods.count = 40;
    scene.rods.length = 0.0;
    scene.motion.brownian = false;
    scene.flow.shear_rate = 0.7;
    scene.flow.start_strain = 0.4;
    scene.time.step = 0.01;
    Simulation simulation = started(scene);
    CHECK(simulation.box().offset() == doctest::Approx(0.4 * 12));
    CHECK(largest_overlap(simulation.rods(), simulation.box()) <= 0.0);
    make_steps(simulation, 1500);
    CHECK(largest_overlap(simulation.rods(), simulation.box()) < 1e-4);
}

TEST_CASE("sheared rods do not overlap, and oscillating ones come back to the box they began in") {
    Simulation simulation = started(crowd());
    std::size_t active = 0;
    for (int step = 0; step < 900; ++step) {  // over four jumps of the copies
        const StepReport report = simulation.step();
        REQUIRE(report.status == LcpStatus::converged);
        REQUIRE(report.max_overlap < 0.05);
        active += report.active_contacts;
    }
    INFO(active);
    CHECK(active > 9000);

    Scene scene = crowd();
    scene.flow = {0.0, 0.3, 5.0, 0.0};
    Simulation to_and_fro = started(scene);
    make_steps(to_and_fro, 25);
    CHECK(to_and_fro.box().offset() == doctest::Approx(0.3 * to_and_fro.box().edges().y));
    make_steps(to_and_fro, 75);
    CHECK(std::fabs(to_and_fro.box().offset()) < 1e-12);
}

TEST_CASE("a rate of 0 leaves the bits of rods at rest") {
    Scene scene = crowd();
    scene.flow = {};
    Simulation at_rest = started(scene);
    const Box box = box_at_start(scene);
    SimulationSettings settings = at_rest.settings();
    settings.flow = ShearFlow{};
    Simulation not_sheared({box, make_start(scene, box)}, make_mobility(scene), motions_of(scene), settings);
    make_steps(at_rest, 60);
    make_steps(not_sheared, 60);
    check_same_state(at_rest, not_sheared);
}

TEST_CASE("a sheared run that is stopped goes on to the same bits, wherever rods stand in memory") {
    for (const WarmStarts warm_start : {WarmStarts::never, WarmStarts::always})
        for (const bool oscillates : {false, true}) {
            Scene scene = crowd();
            if (oscillates) scene.flow = {0.0, 0.9, 2.0, 0.1};
            scene.solver.warm_start = warm_start;
            Simulation whole = started(scene), parts = started(scene);
            std::vector<std::uint32_t> reversed(scene.rods.count);
            for (std::uint32_t i = 0; i < reversed.size(); ++i)
                reversed[i] = static_cast<std::uint32_t>(reversed.size()) - 1 - i;
            for (int part = 0; part < 5; ++part) {
                make_steps(whole, 50);
                Simulation going_on = assemble(scene, in_order_of_ids(parts.state()));
                going_on.reorder(reversed);
                make_steps(going_on, 50);
                check_same_state(whole, going_on);
                parts = std::move(going_on);
            }
        }
}

TEST_CASE("a box that is not sheared as the flow has it is refused") {
    const Scene scene = crowd();
    const Simulation simulation = started(scene);
    State state = simulation.state();
    state.box = state.box.sheared(0.1);
    CHECK_THROWS_AS(assemble(scene, state), InputError);
}
