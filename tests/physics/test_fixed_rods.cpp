// Exact relations of rods among fixed rods (theory, section 6). Statistical checks allow four standard errors of their
// own sample (false alarm 6e-5 each).

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "jostle/setup/assemble.hpp"
#include "jostle/setup/largest_overlap.hpp"
#include "jostle/setup/start.hpp"
#include "jostle/simulation/contact_by_id.hpp"
#include "support/sample.hpp"

using namespace jostle;

namespace {

Box with_fixed(const Box& box, Rods fixed) {
    return box.with_fixed_rods(std::make_shared<const Rods>(std::move(fixed)));
}

/// Without noise, in steps of 0.01.
Scene quiet_scene(double length) {
    Scene scene;
    scene.rods.count = 1;
    scene.rods.length = length;
    scene.motion.brownian = false;
    scene.time.step = 0.01;
    scene.solver.tolerance = 1e-9;
    scene.forces.on_rods = {0, 0, -2};
    scene.forces.drift = true;
    scene.rods.fixed = "two.csv";
    return scene;
}

/// Two fixed rods along x, 2 a apart.
Rods trough(double a) {
    Rods fixed;
    fixed.push_back(0, {5, 5 - a, 4}, {1, 0, 0}, 8.0, 1.0);
    fixed.push_back(1, {5, 5 + a, 4}, {1, 0, 0}, 8.0, 1.0);
    return fixed;
}

}  // namespace

TEST_CASE("a sphere, and a rod, that lie on two fixed rods press on each with f/(2 cos alpha)") {
    const double a = 0.7, height = std::sqrt(1.0 - a * a);
    for (const double length : {0.0, 3.0}) {
        const Scene scene = quiet_scene(length);
        const Box box = with_fixed(Box{{10, 10, 10}}, trough(a));
        Rods rods;
        rods.push_back(0, {5, 5.2, 5.5}, {1, 0, 0}, length, 1.0);
        Simulation simulation = assemble(scene, {box, rods});
        StepReport report;
        for (int k = 0; k < 4000; ++k) {
            report = simulation.step();
            REQUIRE(report.status == LcpStatus::converged);
        }
        CHECK(simulation.rods().centre[0].y == doctest::Approx(5.0).epsilon(1e-6));
        CHECK(simulation.rods().centre[0].z == doctest::Approx(4.0 + height).epsilon(1e-6));
        CHECK(norm(report.fixed_rod_force - Vec3{0, 0, -2}) < 1e-5);
        double on_each[2] = {0.0, 0.0};
        for (std::size_t l = 0; l < simulation.contacts().size(); ++l)
            on_each[contact_by_id(simulation, l).fixed] += simulation.contact_solution().gamma[l];
        CHECK(on_each[0] == doctest::Approx(2.0 / (2.0 * height)).epsilon(1e-5));
        CHECK(on_each[1] == doctest::Approx(2.0 / (2.0 * height)).epsilon(1e-5));
        // (r_j - x_w) F with x_w on the surface: half a diameter of the rod along each normal.
        CHECK(report.collision_virial(2, 2) == doctest::Approx(0.5 * height * 2.0).epsilon(1e-5));
    }
}

TEST_CASE("a swimmer, and a rod under a force, do not pass through a fixed rod in long steps") {
    Scene scene = quiet_scene(2.0);
    scene.forces.on_rods = {0, 0, -40};
    scene.time.step = 0.1;
    Rods fixed;
    fixed.push_back(0, {5, 5, 5}, {1, 0, 0}, 6.0, 1.0);
    const Box box = with_fixed(Box{{10, 10, 10}, {false, false, false}}, fixed);
    Rods rods;
    rods.push_back(0, {5, 5, 7}, {0, 1, 0}, 2.0, 1.0);
    Simulation simulation = assemble(scene, {box, rods});
    for (int k = 0; k < 30; ++k) {
        const StepReport report = simulation.step();
        REQUIRE(report.status == LcpStatus::converged);
        CHECK(report.max_overlap < 0.02);
    }
    CHECK(simulation.rods().centre[0].z == doctest::Approx(6.0).epsilon(0.01));  // it balances on the fixed one
}

TEST_CASE(
    "one rod among a fixed one and its copies: the force between them is kT times the growth of what it excludes") {
    // <sum of gamma> = n kT dV/dR, of the volume V = 2 R L_1 L_2 <sin> + pi R^2 (L_1 + L_2) + 4/3 pi R^3 that a rod
    // excludes, in the mean over its directions, with <sin> = pi/4 and R the distance of touching.
    const double length = 2.0, fixed_length = 3.0, R = 1.25, edge = 8.0, pi = std::numbers::pi;
    const double excluded =
        0.5 * pi * R * length * fixed_length + pi * R * R * (length + fixed_length) + 4.0 / 3.0 * pi * R * R * R;
    const double growth = 0.5 * pi * length * fixed_length + 2.0 * pi * R * (length + fixed_length) + 4.0 * pi * R * R;
    const double exact = growth / (edge * edge * edge - excluded);
    Rods fixed;
    fixed.push_back(0, {1, 4, 7}, normalised(Vec3{1, 2, 3}), fixed_length, 1.5);
    const Box box = with_fixed(Box{{edge, edge, edge}}, fixed);
    std::vector<double> means;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        Scene scene;
        scene.rods.count = 1;
        scene.rods.length = length;
        scene.rods.fixed = "one.csv";
        scene.time.rms_step = 0.1;
        scene.seed = seed;
        Simulation simulation = assemble(scene, {box, make_start(scene, box)});
        REQUIRE(largest_overlap(simulation.rods(), box) == 0.0);
        double sum = 0.0;
        const int steps = 20000;
        for (int k = 0; k < steps; ++k) {
            const StepReport report = simulation.step();
            REQUIRE(report.status == LcpStatus::converged);
            for (const double gamma : simulation.contact_solution().gamma) sum += gamma / steps;
        }
        means.push_back(sum);
    }
    const test::Sample forces(means);
    MESSAGE("<sum of forces> = " << forces.mean << " +- " << forces.error << " kT/D, exact " << exact);
    CHECK(forces.error < 0.05 * exact);
    CHECK(forces.agrees_with(exact));
}

TEST_CASE("a crowd among fixed rods starts without overlap, and its bits do not know the rows") {
    Scene scene;
    scene.rods.count = 120;
    scene.rods.length = 2.0;
    scene.rods.fixed = "pillars.csv";
    scene.time.rms_step = 0.06;
    scene.forces.on_rods = {0, 0, -1};
    scene.walls.faces = {false, false, true};
    Rods fixed;
    for (std::uint64_t k = 0; k < 4; ++k)
        fixed.push_back(k, {2.5 + 5.0 * static_cast<double>(k % 2), 2.5 + 5.0 * static_cast<double>(k / 2), 4},
                        {0, 0, 1}, 8.0, 2.0);
    fixed.push_back(4, {5, 5, 3}, normalised(Vec3{1, 1, 0}), 4.0, 1.0);
    const Box box = with_fixed(Box{{10, 10, 8}, {true, true, false}, {{false, false, true}}}, fixed);
    const Rods start = make_start(scene, box);
    REQUIRE(largest_overlap(start, box) == 0.0);
    Simulation simulation = assemble(scene, {box, start}), other = assemble(scene, {box, start});
    for (int k = 0; k < 400; ++k) {
        if (k % 50 == 20) {
            std::vector<std::uint32_t> order(other.rods().size());
            for (std::uint32_t row = 0; row < order.size(); ++row)
                order[row] = static_cast<std::uint32_t>(order.size()) - 1 - row;
            other.reorder(order);
        }
        const StepReport report = simulation.step(), again = other.step();
        REQUIRE(report.status == LcpStatus::converged);
        CHECK(report.fixed_rod_force == again.fixed_rod_force);
        CHECK(report.collision_virial.m == again.collision_virial.m);
    }
    const State a = in_order_of_ids(simulation.state()), b = in_order_of_ids(other.state());
    CHECK(a.rods.centre == b.rods.centre);
    CHECK(a.rods.axis == b.rods.axis);
    CHECK(largest_overlap(a.rods, box) < 0.1);
}
