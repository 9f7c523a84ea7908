// Planes that a bath of pressure moves (theory, section 10): a row of spheres in a tube, whose length is known exactly,
// and rows that are compressed without thermal motion. Statistical checks allow four standard errors of their own
// sample (false alarm 6e-5).

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"

using namespace jostle;

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

/// The mean length and variance of a row of spheres D = 1 under a force f (in kT), by the weights of where they stand
/// across the tube: neighbours at a and b are at least c = sqrt(1 - (a - b)^2) apart along it, and Z(f) = f^-(N+1)
/// exp(-f) sum over places of the product of exp(-f c).
struct Row {
    double mean = 0.0, variance = 0.0;
};

double log_partition(std::uint64_t count, double room, double f) {
    constexpr int places = 300;
    std::vector<double> y(places), z(places), weight(places, 1.0), next(places);
    for (int k = 0; k < places; ++k) {  // evenly over the disc
        const double r = room * std::sqrt((k + 0.5) / places), angle = k * std::numbers::pi * (3.0 - std::sqrt(5.0));
        y[static_cast<std::size_t>(k)] = r * std::cos(angle);
        z[static_cast<std::size_t>(k)] = r * std::sin(angle);
    }
    double scale = 0.0;
    for (std::uint64_t n = 1; n < count; ++n) {
        double sum = 0.0;
        for (std::size_t a = 0; a < places; ++a) {
            next[a] = 0.0;
            for (std::size_t b = 0; b < places; ++b) {
                const double apart = (y[a] - y[b]) * (y[a] - y[b]) + (z[a] - z[b]) * (z[a] - z[b]);
                next[a] += weight[b] * std::exp(-f * std::sqrt(1.0 - apart));
            }
            sum += next[a];
        }
        scale += std::log(sum / places);
        for (std::size_t a = 0; a < places; ++a) weight[a] = next[a] * places / sum;
    }
    return scale - f - (static_cast<double>(count) + 1.0) * std::log(f);
}

Row exact_row(std::uint64_t count, double room, double f) {
    const double h = 1e-3 * f;
    const double low = log_partition(count, room, f - h), at = log_partition(count, room, f),
                 high = log_partition(count, room, f + h);
    return {(low - high) / (2.0 * h), (low - 2.0 * at + high) / (h * h)};
}

}  // namespace

TEST_CASE("a row of spheres under a piston has the length, and the variance, of Tonks") {
    const double radius = 0.75, f = 1.0;  // kT/D
    Scene scene = row_of(10, radius, 2.0, f);
    scene.time.rms_step = 0.08;
    Simulation row = assemble(scene, row_at(scene, 2.0));
    const Row exact = exact_row(10, radius - 0.5, f);
    CHECK(exact.mean == doctest::Approx(1.0 + 9.0 + 11.0).epsilon(0.02));  // less the zigzag
    for (int k = 0; k < 20000; ++k) row.step();
    constexpr int blocks = 40, steps = 40000;
    std::vector<double> means;
    double mean = 0.0, square = 0.0;
    for (int block = 0; block < blocks; ++block) {
        double sum = 0.0;
        for (int k = 0; k < steps; ++k) {
            const StepReport report = row.step();
            REQUIRE(report.status == LcpStatus::converged);
            const double length = row.box().edges().x;
            sum += length / steps;
            square += (length - exact.mean) * (length - exact.mean) / (steps * blocks);
        }
        means.push_back(sum);
        mean += sum / blocks;
    }
    double deviation = 0.0;
    for (const double value : means) deviation += (value - mean) * (value - mean);
    const double error = std::sqrt(deviation / (blocks * (blocks - 1.0)));
    const double variance = square - (mean - exact.mean) * (mean - exact.mean);
    MESSAGE("length " << mean << " +- " << error << ", exact " << exact.mean << "; variance over exact "
                      << variance / exact.variance);
    CHECK(error < 0.012 * exact.mean);
    CHECK(std::fabs(mean - exact.mean) < 4.0 * error);
    CHECK(variance == doctest::Approx(exact.variance).epsilon(0.3));
}

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
