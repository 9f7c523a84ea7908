// Exact relations of rods that forces pull and torques turn (theory, sections 1 and 2.9). Statistical checks allow four
// standard errors of their own sample (false alarm 6e-5 each).

#include <doctest/doctest.h>

#include <cmath>

#include "jostle/motion/brownian_motion.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"
#include "jostle/stress/orientation_stress.hpp"
#include "support/sample.hpp"

using namespace jostle;
using test::Sample;

namespace {

/// Integral of f from a to b, by Simpson's rule.
template <class Function>
double integral(Function&& f, double a, double b) {
    constexpr int pieces = 2000;
    const double h = (b - a) / pieces;
    double sum = f(a) + f(b);
    for (int k = 1; k < pieces; ++k) sum += (k % 2 == 1 ? 4.0 : 2.0) * f(a + k * h);
    return sum * h / 3.0;
}

Scene scene_of(double length, std::uint64_t count, double rms_step) {
    Scene scene;
    scene.rods.count = count;
    scene.rods.length = length;
    scene.time.rms_step = rms_step;
    return scene;
}

}  // namespace

TEST_CASE("spheres that do not meet settle as the barometric formula has it; floor less ceiling bears their weight") {
    const double weight = 0.5, height = 7.0, free = height - 1.0;
    Scene scene = scene_of(0.0, 2000, 0.08);
    scene.forces.on_rods = {0, 0, -weight};
    scene.walls.faces = {false, false, true};
    const Box box{{1e5, 1e5, height}, {true, true, false}, {{false, false, true}}};
    Simulation simulation = assemble(scene, {box, make_start(scene, box)});
    CHECK(simulation.keeps_equilibrium());
    const std::size_t count = simulation.rods().size();
    const auto number = static_cast<double>(count);
    std::vector<double> mean_height(count), lower_third(count);
    double floor = 0.0, ceiling = 0.0, noise = 0.0, from = 0.0;
    const double dt = simulation.settings().time_step;
    const auto sum_of_heights = [&] {
        double sum = 0.0;
        for (const Vec3& centre : simulation.rods().centre) sum += centre.z;
        return sum;
    };
    const double mobility = simulation.mobility().at(simulation.rods(), box)->of_rod(0).perpendicular;
    const int settling = 3000, steps = 8000;
    for (int k = -settling; k < steps; ++k) {
        if (k == 0) from = sum_of_heights();
        if (k >= 0) {
            Velocities brownian(count);
            BrownianMotion(1.0).add_velocities(brownian, simulation.rods(),
                                               *simulation.mobility().at(simulation.rods(), box),
                                               {scene.seed, simulation.clock().step, dt});
            for (const Vec3& velocity : brownian.linear) noise += velocity.z / steps;
        }
        const StepReport report = simulation.step();
        REQUIRE(report.status == LcpStatus::converged);
        if (k < 0) continue;
        floor += report.wall_force[4] / steps;
        ceiling += report.wall_force[5] / steps;
        const Rods& rods = simulation.rods();
        for (std::size_t i = 0; i < count; ++i) {
            const double z = rods.centre[i].z - 0.5;
            mean_height[rods.id[i]] += z / steps;
            lower_third[rods.id[i]] += (z < free / 3.0 ? 1.0 : 0.0) / steps;
        }
    }
    const auto density = [&](double z) { return std::exp(-weight * z); };
    const double norm = integral(density, 0.0, free);
    const Sample measured(mean_height), lower(lower_third);
    const double exact = integral([&](double z) { return z * density(z); }, 0.0, free) / norm;
    MESSAGE("mean height " << measured.mean << " +- " << measured.error << ", exact " << exact);
    MESSAGE("floor " << floor / number << ", ceiling " << ceiling / number << " of each");
    CHECK(measured.error < 0.01 * exact);
    CHECK(measured.agrees_with(exact));
    CHECK(lower.agrees_with(integral(density, 0.0, free / 3.0) / norm));
    // What moves them in all: weight, walls and noise.
    const double moved = (sum_of_heights() - from) / (steps * dt);
    CHECK(floor - ceiling == doctest::Approx(number * weight + (moved - noise) / mobility).epsilon(1e-7));
    CHECK(std::fabs(floor - ceiling - number * weight) <
          4.0 * std::sqrt(2.0 * number / (mobility * steps * dt)) + std::fabs(moved) / mobility);
    CHECK(ceiling / number == doctest::Approx(density(free) / norm).epsilon(0.05));
}

TEST_CASE("free rods that a torque aligns have the order of Boltzmann, and its stress is against that of orientation") {
    for (const double energy : {2.0, -3.0}) {
        std::vector<double> squared, stress;  // of a rod, and of a gas of its own
        for (std::uint64_t seed = 1; seed <= 30; ++seed) {
            Scene scene = scene_of(4.0, 100, 0.03);
            scene.seed = seed;
            scene.forces.alignment_energy = energy;
            scene.forces.alignment_axis = {0, 0, 2};
            const Box box{{1e4, 1e4, 1e4}};
            Simulation simulation = assemble(scene, {box, make_start(scene, box)});
            CHECK(simulation.keeps_equilibrium());
            constexpr int settling = 4000, rows = 800, a_row = 10;
            std::vector<double> of_rod(simulation.rods().size());
            double sum = 0.0;
            for (int k = 0; k < settling; ++k) simulation.step();
            for (int row = 0; row < rows; ++row) {
                for (int k = 0; k < a_row; ++k) sum += simulation.step().torque_virial(2, 2) / a_row;
                const Rods& rods = simulation.rods();
                sum += sum_of_orientation_stresses(rods, 1.0)(2, 2);
                for (std::size_t i = 0; i < rods.size(); ++i)
                    of_rod[rods.id[i]] += rods.axis[i].z * rods.axis[i].z / rows;
            }
            squared.insert(squared.end(), of_rod.begin(), of_rod.end());
            stress.push_back(sum / (rows * static_cast<double>(of_rod.size())));
        }
        const auto weight = [&](double x) { return std::exp(energy * x * x); };
        const double exact =
            integral([&](double x) { return x * x * weight(x); }, 0.0, 1.0) / integral(weight, 0.0, 1.0);
        const Sample order(squared), total(stress);
        MESSAGE("<(n.h)^2> = " << order.mean << " +- " << order.error << ", exact " << exact << "; stress of both "
                               << total.mean << " +- " << total.error << " kT a rod");
        CHECK(order.error < 0.01);
        CHECK(std::fabs(order.mean - exact) < 4.0 * order.error + 0.002);  // of the time step: half of 1 % of an angle
        CHECK(total.error < 0.02);
        CHECK(std::fabs(total.mean) < 4.0 * total.error + 0.01);  // of the time step
    }
}

TEST_CASE("a sphere that nothing stops falls with mu f") {
    Scene scene = scene_of(0.0, 1, 0.1);
    scene.motion.brownian = false;
    scene.time.rms_step.reset();
    scene.time.step = 0.01;
    scene.forces.on_rods = {0, 2, 0};
    scene.forces.drift = true;
    const Box box{{5, 5, 5}};
    Rods rods;
    rods.push_back(0, {1, 1, 1}, {1, 0, 0}, 0.0, 1.0);
    Simulation simulation = assemble(scene, {box, rods});
    CHECK(!simulation.keeps_equilibrium());
    const double mobility = simulation.mobility().at(rods, box)->of_rod(0).perpendicular;
    for (int k = 0; k < 10000; ++k) simulation.step();
    const double y = simulation.rods().centre[0].y + 5.0 * simulation.rods().image[0][1];
    CHECK(y - 1.0 == doctest::Approx(100.0 * mobility * 2.0).epsilon(1e-9));
}
