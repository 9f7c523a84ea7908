// Spheres that turn with the fluid and stir it by turning (theory, 7.8): couples do not change equilibrium, and
// swimmers of a scene turn each other.

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "jostle/scene/scene_box.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"
#include "support/sample.hpp"

using namespace jostle;

namespace {

constexpr std::uint64_t seed = 20261125;

/// <x^2> of exp(energy x^2), x from 0 to 1.
double mean_square(double energy) {
    constexpr int points = 2000;
    double all = 0.0, squares = 0.0;
    for (int n = 0; n < points; ++n) {
        const double x = (n + 0.5) / points, weight = std::exp(energy * x * x);
        all += weight;
        squares += weight * x * x;
    }
    return squares / all;
}

}  // namespace

TEST_CASE("spheres that a torque aligns in a fluid: Z of hard spheres, and directions of Boltzmann") {
    constexpr double phi = 0.2, energy = 1.0;
    constexpr int count = 48;
    constexpr int steps = 16000, block = 800;
    Scene scene;
    scene.seed = seed;
    scene.box.volume_fraction = phi;
    scene.rods.count = count;
    scene.rods.length = 0.0;
    scene.mobility.model = MobilityModel::hydrodynamic;
    scene.forces.alignment_energy = energy;
    scene.solver.tolerance = 1e-4;
    scene.time.rms_step = 0.05;
    const Box box{box_edges(scene), {true, true, true}};
    Simulation simulation = assemble(scene, {box, make_start(scene, box)});
    std::vector<double> Z, squares;  // of blocks, which are long beside the 1/(6 D_R) in which directions are forgotten
    const double forgetting = 6.0 * scene.fluid.kT / (std::numbers::pi * scene.fluid.viscosity);
    REQUIRE(block * simulation.settings().time_step * forgetting > 6.0);
    for (int step = 0; step < steps; ++step) {
        const StepReport report = simulation.step();
        REQUIRE(report.status == LcpStatus::converged);
        if (step < steps / 10) continue;
        if (step % block == 0) {
            Z.push_back(1.0);
            squares.push_back(0.0);
        }
        Z.back() += trace(report.collision_virial) / (3.0 * count * block);
        for (const Vec3& axis : simulation.state().rods.axis) squares.back() += axis.z * axis.z / (count * block);
    }
    const auto check = [](const std::string& name, const test::Sample& found, double expected) {
        MESSAGE(name, " = ", found.mean, " +- ", found.error, ", expected ", expected);
        CHECK(found.error < 0.015 * expected);  // or the comparison would say nothing
        CHECK(std::fabs(found.mean - expected) <= 0.01 * expected + 2.5 * found.error);
    };
    check("Z", test::Sample(Z), (1 + phi + phi * phi - phi * phi * phi) / std::pow(1 - phi, 3));  // Carnahan-Starling
    check("<(n.h)^2>", test::Sample(squares), mean_square(energy));
}

// Half the vorticity of a dipole's flow: 3 p (n.R) n x R/(8 pi mu R^5).
TEST_CASE("two swimming spheres of a scene turn each other by half the vorticity of their dipoles") {
    Scene scene;
    scene.box.edges = Vec3{40, 40, 40};
    scene.box.periodic = {false, false, false};
    scene.rods.count = 2;
    scene.rods.length = 0.0;
    scene.mobility.model = MobilityModel::hydrodynamic;
    scene.motion.brownian = false;
    scene.motion.self_propulsion = 0.5;
    scene.motion.force_dipole = 30.0;
    scene.time.step = 1e-3;
    Rods rods;
    rods.push_back(0, {18, 20, 20}, normalised(Vec3{1, 2, -0.5}), 0.0, 1.0);
    rods.push_back(1, {22, 21, 19}, normalised(Vec3{-0.3, 1, 1}), 0.0, 1.0);
    Simulation simulation = assemble(scene, {Box{{40, 40, 40}, {false, false, false}}, rods});
    REQUIRE(simulation.step().status == LcpStatus::converged);
    for (std::size_t row = 0; row < 2; ++row) {
        const auto i = static_cast<std::size_t>(simulation.state().rods.id[row]);
        const Vec3 apart = rods.centre[i] - rods.centre[1 - i], &stirs = rods.axis[1 - i];
        const double size = 3.0 * 30.0 * dot(stirs, apart) / (8.0 * std::numbers::pi * std::pow(norm(apart), 5));
        const Vec3 turn = cross(size * cross(stirs, apart), rods.axis[i]) * 1e-3;
        CHECK(norm(turn) > 1e-6);
        CHECK(norm(simulation.state().rods.axis[row] - rods.axis[i] - turn) < 1e-3 * norm(turn));
    }
}
