// Rows of spheres in a narrow tube: under a piston, without thermal motion and with it, and between fixed ends (theory,
// section 10).

#include <doctest/doctest.h>

#include <numbers>

#include "jostle/mobility/drag.hpp"
#include "jostle/setup/assemble.hpp"
#include "support/sample.hpp"

using namespace jostle;
using test::Sample;

namespace {

/// Spheres in a tube along x, so narrow that none passes another, its upper end a piston under a load.
Scene row_of(std::uint64_t count, double radius, double distance, double load) {
    Scene scene;
    scene.rods.count = count;
    scene.rods.length = 0.0;
    scene.walls.container = Container::tube;
    scene.walls.axis = Direction::x;
    scene.walls.faces = {true, false, false};
    scene.box.periodic = {false, false, false};
    scene.box.edges = Vec3{static_cast<double>(count) * distance, 2.0 * radius, 2.0 * radius};
    scene.pressure.external = load / (std::numbers::pi * radius * radius);
    scene.pressure.coupling = StrainCoupling::piston;
    return scene;
}

State row_at(const Scene& scene, double distance) {
    State state;
    state.box = Box{*scene.box.edges, {false, false, false}, {{true, false, false}, Container::tube, 0}};
    const double radius = 0.5 * scene.box.edges->y;
    for (std::uint64_t k = 0; k < scene.rods.count; ++k)
        state.rods.push_back(k, {(static_cast<double>(k) + 0.5) * distance, radius, radius}, {1, 0, 0}, 0.0, 1.0);
    return state;
}

}  // namespace

TEST_CASE("a row without thermal motion is pressed together until it bears the load of the piston") {
    Scene scene = row_of(5, 0.5, 1.5, 10.0);
    scene.fluid.kT = 0.0;
    scene.solver.tolerance = 1e-8;
    Simulation row = assemble(scene, row_at(scene, 1.5));
    StepReport last;
    for (int k = 0; k < 2000; ++k) {
        last = row.step();
        REQUIRE(last.status == LcpStatus::converged);
    }
    MESSAGE("length " << row.box().edges().x << ", force " << last.wall_force[1] << ", " << last.wall_force[0]);
    CHECK(row.box().edges().x == doctest::Approx(5.0).epsilon(1e-5));
    CHECK(last.wall_force[1] == doctest::Approx(10.0).epsilon(1e-4));
    CHECK(last.wall_force[0] == doctest::Approx(last.wall_force[1]).epsilon(1e-4));
}

TEST_CASE("a row in thermal motion has the length, and bears the load, that equilibrium demands") {
    // <H> = -d ln Z/df and var H by quadrature over the places across the tube: studies/constant_pressure.py. Without
    // the zigzag they would be 3 D + 4 kT/f and 4 (kT/f)^2.
    constexpr double load = 3.0, exact = 4.264010, exact_variance = 0.446224, of_a_sphere = 0.3;
    std::vector<double> lengths, spreads, forces;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        Scene scene = row_of(3, 0.75, 1.5, load);
        scene.seed = seed;
        scene.time.rms_step = 0.06;
        const double edge = scene.box.edges->x;
        scene.pressure.relaxation_time =  // its mobility is edge^2/(time N kT)
            edge * edge / (3.0 * scene.fluid.kT * of_a_sphere * capsule_drag(0.0, 1.0, scene.fluid.viscosity).parallel);
        Simulation row = assemble(scene, row_at(scene, 1.5));
        for (int k = 0; k < 5000; ++k) row.step();
        for (int block = 0; block < 6; ++block) {  // each some 10 times as long as the row relaxes
            double length = 0.0, spread = 0.0, force = 0.0;
            constexpr int steps = 10000;
            for (int k = 0; k < steps; ++k) {
                const StepReport report = row.step();
                REQUIRE(report.status == LcpStatus::converged);
                const double now = row.box().edges().x;
                length += now / steps;
                spread += (now - exact) * (now - exact) / steps;
                force += report.wall_force[1] / steps;
            }
            lengths.push_back(length);
            spreads.push_back(spread);
            forces.push_back(force / load);
        }
    }
    const Sample length(lengths), spread(spreads), force(forces);
    MESSAGE("length " << length.mean << " +- " << length.error << " D, exact " << exact << "; variance " << spread.mean
                      << " +- " << spread.error << " D2, exact " << exact_variance << "; force over load " << force.mean
                      << " +- " << force.error);
    CHECK(length.error < 0.02 * exact);
    CHECK(length.agrees_with(exact));
    CHECK(spread.agrees_with(exact_variance));
    CHECK(force.error < 0.05);
    CHECK(force.agrees_with(1.0));
}

TEST_CASE("a row between fixed ends presses on them as Tonks' gas does, but for its zigzag") {
    // kT d ln Z/dl with Z = <(l - D - s)^3>, s the sum of the two spacings, by quadrature over the places across the
    // tube: studies/constant_pressure.py. Without the zigzag it would be 3 kT/(l - 3 D) = 1.
    constexpr double exact = 0.978697, distance = 2.0;
    std::vector<double> blocks;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        Scene scene = row_of(3, 0.75, distance, 1.0);
        scene.seed = seed;
        scene.pressure = {};
        scene.time.rms_step = 0.06;
        Simulation row = assemble(scene, row_at(scene, distance));
        for (int k = 0; k < 5000; ++k) row.step();
        for (int block = 0; block < 6; ++block) {  // each some 20 times as long as the row relaxes
            double force = 0.0;
            constexpr int steps = 10000;
            for (int k = 0; k < steps; ++k) {
                const StepReport report = row.step();
                REQUIRE(report.status == LcpStatus::converged);
                force += 0.5 * (report.wall_force[0] + report.wall_force[1]) / steps;
            }
            blocks.push_back(force);
        }
    }
    const Sample force(blocks);
    MESSAGE("force on an end = " << force.mean << " +- " << force.error << " kT/D, exact " << exact);
    CHECK(force.error < 0.03);
    CHECK(force.agrees_with(exact));
}
