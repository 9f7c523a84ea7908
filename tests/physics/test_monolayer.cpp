// Rods in two dimensions (theory, section 9).
//
// Z of hard discs at the default step against the virial series to B10 (Clisby and McCoy, J. Stat. Phys. 122, 15
// (2006), with a linear tail): within 0.5 % plus two standard errors. Free swimmers: exact sums over pairs of steps.

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <numbers>

#include "jostle/parallel/parallel_for.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"
#include "jostle/statistics/order_parameter.hpp"
#include "jostle/statistics/time_series.hpp"
#include "jostle/stress/orientation_stress.hpp"
#include "jostle/stress/spherocylinder_moments.hpp"

using namespace jostle;

namespace {

Scene monolayer(std::uint64_t count, double length, double area_fraction) {
    Scene scene;
    scene.seed = 20261123;
    scene.box.dimensions = 2;
    scene.box.area_fraction = area_fraction;
    scene.rods.count = count;
    scene.rods.length = length;
    scene.time.production = 1.0;
    leave_out_z(scene);
    return scene;
}

Simulation begun(const Scene& scene) {
    const Box box{box_edges(scene), box_periodic(scene)};
    return assemble(scene, {box, make_start(scene, box)});
}

bool is_plus_zero(double value) {
    return std::bit_cast<std::uint64_t>(value) == 0;
}

std::size_t out_of_plane(const Rods& rods) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < rods.size(); ++i)
        if (!is_plus_zero(rods.centre[i].z) || !is_plus_zero(rods.axis[i].z)) ++count;
    return count;
}

StepReport step_of(Simulation& simulation) {
    StepReport report = simulation.step();
    REQUIRE(report.status == LcpStatus::converged);
    return report;
}

}  // namespace

TEST_CASE("after 100,000 steps the bits of z and n_z are those of 0") {
    Scene scene = monolayer(24, 4.0, 0.45);
    scene.motion = {true, 2.0, 0.5, 1.0, 0.02, 2.0};  // swims at speeds that differ, tumbles, turns round
    scene.time.step = 2e-3;
    Simulation simulation = begun(scene);
    CHECK(out_of_plane(simulation.rods()) == 0);
    Mat3 collision;
    for (int step = 0; step < 100000; ++step) collision += step_of(simulation).collision_virial;
    CHECK(out_of_plane(simulation.rods()) == 0);
    CHECK(trace(collision) > 0.0);
    for (const int k : {2, 5, 6, 7, 8}) CHECK(collision.m[static_cast<std::size_t>(k)] == 0.0);
    for (std::size_t i = 0; i < simulation.rods().size(); ++i)
        CHECK(norm(simulation.rods().axis[i]) == doctest::Approx(1.0).epsilon(1e-12));
}

TEST_CASE("cells of a colony and their daughters stay in the plane") {
    Scene scene = monolayer(1, 2.0, 0.1);
    scene.box.area_fraction.reset();
    scene.box.edges = Vec3{50, 50, 0};
    scene.box.periodic = {false, false, false};
    scene.motion.brownian = false;
    scene.growth.rate = 1.0;
    scene.growth.rate_deviation = 0.2;
    scene.growth.division_length = 4.0;
    scene.growth.daughters = DaughterDirection::opposite;
    Simulation simulation = begun(scene);
    while (simulation.rods().size() < 200) step_of(simulation);
    CHECK(out_of_plane(simulation.rods()) == 0);
    CHECK(nematic_order(simulation.rods().axis, 2).order < 0.9);  // pushed out of line, in the plane
}

TEST_CASE("Z of hard discs agrees with the virial series within 0.5 % plus two standard errors") {
    struct State {
        double area_fraction, Z;
        int rows;
    };
    for (const auto& [area_fraction, Z, rows] : {State{0.3, 2.06326, 1600}, State{0.5, 4.1063, 2400}}) {
        constexpr int steps_per_row = 10, settling = 100;
        const Scene scene = monolayer(400, 0.0, area_fraction);
        Simulation simulation = begun(scene);
        std::vector<double> measured;
        for (int row = -settling; row < rows; ++row) {
            double virial = 0.0;
            for (int step = 0; step < steps_per_row; ++step)
                virial += trace(step_of(simulation).collision_virial) / steps_per_row;
            if (row >= 0) measured.push_back(1.0 + virial / (2.0 * static_cast<double>(scene.rods.count)));
        }
        const Average found = average(measured);
        REQUIRE(found.standard_error.has_value());
        MESSAGE("area fraction ", area_fraction, ": Z = ", found.mean, " +- ", *found.standard_error, ", expected ", Z,
                ", difference ", 100.0 * (found.mean / Z - 1.0), " %");
        CHECK(*found.standard_error < 0.012 * Z);
        CHECK(std::fabs(found.mean - Z) <= 0.005 * Z + 2.0 * *found.standard_error);
    }
}

// In equilibrium the geometric part of the collision stress is n kT B Q_2, and the orientation stress takes it away
// (theory, eq. 9.4). Rods that begin aligned, and stay so: a mean over the run, with its own error of 20 parts.
TEST_CASE("the orientation stress is the geometric part of the collision stress with the opposite sign") {
    Scene scene = monolayer(120, 8.0, 0.6);
    scene.rods.start = StartKind::aligned;
    Simulation simulation = begun(scene);
    const auto count = static_cast<double>(scene.rods.count), B = moment_anisotropy(8.0);
    for (int step = 0; step < 1000; ++step) step_of(simulation);
    double difference = 0.0, squares = 0.0, S = 0.0;
    constexpr int parts = 20, steps = 500;
    for (int part = 0; part < parts; ++part) {
        Mat3 stress, orientation;
        double along = 0.0;
        for (int step = 0; step < steps; ++step) {
            stress += (1.0 / steps) * step_of(simulation).collision_virial;
            orientation += (1.0 / steps) * sum_of_orientation_stresses(simulation.rods(), 1.0, 2);
            along += nematic_order(simulation.rods().axis, 2).tensor(0, 0) / steps;
        }
        CHECK(orientation(0, 0) == doctest::Approx(-count * B * along));
        CHECK(orientation(2, 2) == 0.0);
        // Of n kT I + Sigma_ori + Sigma_col both normal stresses are one.
        const double of_part = (stress(0, 0) + orientation(0, 0) - stress(1, 1) - orientation(1, 1)) / count;
        difference += of_part / parts;
        squares += of_part * of_part / parts;
        S += along / parts;
    }
    const double error = std::sqrt((squares - difference * difference) / (parts - 1));
    MESSAGE("S = ", S, ", 2 B S = ", 2.0 * B * S, ", difference of the normal stresses ", difference, " +- ", error,
            " n kT");
    CHECK(S > 0.7);
    CHECK(error < 0.2 * 2.0 * B * S);
    CHECK(std::fabs(difference) < 4.0 * error);
}
