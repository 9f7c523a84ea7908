// Dimers of Brownian rods that a spring holds together, far from all others: what equilibrium says of their spring, and
// of their pressure. Every mean is allowed six standard errors, from 40 blocks of its own sample: false alarm 5e-7 of
// each (Student's t).

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "jostle/setup/assemble.hpp"

using namespace jostle;

namespace {

constexpr int blocks = 40;

/// A mean over blocks that are much longer than correlations last.
struct BlockMean {
    std::vector<double> block;
    double value() const {
        double sum = 0.0;
        for (const double mean : block) sum += mean;
        return sum / static_cast<double>(block.size());
    }
    double standard_error() const {
        double squares = 0.0;
        for (const double mean : block) squares += (mean - value()) * (mean - value());
        const auto count = static_cast<double>(block.size());
        return std::sqrt(squares / (count * (count - 1.0)));
    }
};

void check_mean(const BlockMean& mean, double expected, double precision) {
    MESSAGE("expected " << expected << ", found " << mean.value() << " +- " << mean.standard_error());
    CHECK(std::fabs(mean.value() - expected) < 6.0 * mean.standard_error());
    CHECK(mean.standard_error() < precision * std::fabs(expected));  // else the line above proves little
}

/// Dimers at the points of a wide lattice, their two rods head to tail along directions at random.
struct Dimers {
    Scene scene;
    Box box;
    Rods rods;
    std::vector<Spring> springs;

    Dimers(std::size_t per_edge, double length, double diameter, const Spring& spring, double distance, double rms) {
        scene.seed = 5;
        scene.rods.length = length;
        scene.rods.diameter = diameter;
        scene.springs.file = "springs.csv";
        const double apart = 40.0;
        box = {apart * static_cast<double>(per_edge) * Vec3{1, 1, 1}, {true, true, true}};
        std::mt19937_64 generator(31);
        std::normal_distribution<double> normal;
        for (std::size_t k = 0; k < per_edge * per_edge * per_edge; ++k) {
            const auto place = [&](std::size_t n) { return apart * (static_cast<double>(n % per_edge) + 0.5); };
            const Vec3 centre = {place(k), place(k / per_edge), place(k / (per_edge * per_edge))};
            const Vec3 vector = {normal(generator), normal(generator), normal(generator)}, axis = normalised(vector);
            const Vec3 half = length == 0.0 ? (0.5 * rms) * vector : (0.5 * distance) * axis;
            rods.push_back(2 * k, centre - half, axis, length, diameter);
            rods.push_back(2 * k + 1, centre + half, axis, length, diameter);
            springs.push_back(spring);
            springs.back().rod_1 = 2 * k;
            springs.back().rod_2 = 2 * k + 1;
        }
    }

    double mean_square_distance(const Rods& now) const {
        const std::vector<SpringPull> pulls = spring_pulls(springs, now, box);
        double sum = 0.0;
        for (std::size_t l = 0; l < springs.size(); ++l)
            sum += squared_norm(pulls[l].separation(springs[l], now.centre, now.axis));
        return sum / static_cast<double>(springs.size());
    }
};

}  // namespace

// Spheres so small that they do not meet, joined by springs without rest length. In one direction the distance follows
// x' = (1 - a) x + noise of variance 4 kT M dt, a = 2 k M dt: <x^2> = (kT/k)/(1 - a/2), exactly, here 2.6 % above that
// of continuous time. The virial of the force is -3 kT all the same, as its moment is taken half way through what the
// spring does: with the place before the step it would be 2.6 % too large as well, ten times the error bar.
TEST_CASE("points on springs: <r^2> of the discrete step, and the virial -3 kT a dimer") {
    const double kT = 1.0, stiffness = 0.5, diameter = 1e-3, a = 0.05;
    const double expected = 3.0 * kT / stiffness / (1.0 - 0.5 * a);
    Dimers dimers(10, 0.0, diameter, {0, 0, 0.0, 0.0, 0.0, stiffness, {}}, 0.0, std::sqrt(expected / 3.0));
    dimers.scene.time.step = a / (2.0 * stiffness) * 3.0 * std::acos(-1.0) * diameter;
    Simulation simulation = assemble(dimers.scene, {dimers.box, dimers.rods, {}, dimers.springs});
    const double count = static_cast<double>(dimers.springs.size());
    const int steps = static_cast<int>(4.0 / a);  // a block: exp(-4) of the distance, exp(-8) of its square is left
    BlockMean square, virial;
    for (int block = 0; block < blocks; ++block) {
        double virials = 0.0;
        for (int step = 0; step < steps; ++step) {
            const StepReport report = simulation.step();
            REQUIRE(report.status == LcpStatus::converged);
            virials += trace(report.spring_virial + report.collision_virial) / count;
        }
        square.block.push_back(dimers.mean_square_distance(simulation.rods()));
        virial.block.push_back(virials / steps);
    }
    check_mean(square, expected, 0.01);
    check_mean(virial, -3.0 * kT, 0.01);
}

// The whole dimer moves as one particle: its pressure is that of one, kinetic 2 kT less kT of the forces inside. Here
// the rods also collide, and are held at their ends, so that the springs turn them.
TEST_CASE("rods joined end to end, which collide: the pressure of a dimer is kT/V, springs and collisions together") {
    const double length = 0.5, rest = 1.1;
    Dimers dimers(5, length, 1.0, {0, 0, 0.5 * length, -0.5 * length, rest, 30.0, {}}, length + rest, 0.0);
    dimers.scene.time.rms_step = 0.06;
    Simulation simulation = assemble(dimers.scene, {dimers.box, dimers.rods, {}, dimers.springs});
    const double count = static_cast<double>(dimers.springs.size());
    for (int step = 0; step < 4000; ++step) simulation.step();
    BlockMean inside, collisions;
    for (int block = 0; block < blocks; ++block) {
        double sum = 0.0, of_collisions = 0.0;
        for (int step = 0; step < 500; ++step) {
            const StepReport report = simulation.step();
            REQUIRE(report.status == LcpStatus::converged);
            sum += trace(report.spring_virial + report.collision_virial) / (3.0 * count);
            of_collisions += trace(report.collision_virial) / (3.0 * count);
        }
        inside.block.push_back(sum / 500.0);
        collisions.block.push_back(of_collisions / 500.0);
    }
    MESSAGE("collisions alone " << collisions.value());
    CHECK(collisions.value() > 0.5);
    check_mean(inside, -1.0, 0.01);
}
