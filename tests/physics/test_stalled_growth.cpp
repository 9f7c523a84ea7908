// Brownian cells that press on each other grow by what their mean compression leaves them, at any time step (theory,
// eq. 5.1). The force of a single step is a spike: with that the effect would go away as the step becomes shorter.

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "jostle/scene/scene_box.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"

using namespace jostle;

namespace {

constexpr std::size_t cells = 100;
constexpr double stall_force = 6.0, memory = 4.0;
constexpr int blocks = 8;  // of a memory time each, after four in which the start is forgotten

Scene crowd(double time_step) {
    Scene scene;
    scene.seed = 4;
    scene.box.volume_fraction = 0.3;
    scene.rods.count = cells;
    scene.rods.length = 5.0;
    scene.growth.rate = 1e-3;  // hardly: the state stays what it is
    scene.growth.division_length = 100.0;
    scene.growth.stall_force = stall_force;
    scene.growth.stall_memory = memory;
    scene.time.step = time_step;
    scene.time.production = 1.0;
    return scene;
}

/// Means over cells, block by block: of the share of their rate by which they grow, and of F/F_stall.
struct Means {
    std::vector<double> share, compression;
    double largest_bias = 0.0;  ///< of the share: w <F^2>/(F_stall^2 share), share about 0.7
};

Means grow(double time_step) {
    const Scene scene = crowd(time_step);
    const Box box{box_edges(scene, rods_volume(scene)), {true, true, true}};
    Simulation simulation = assemble(scene, {box, make_start(scene, box)});
    const auto steps = static_cast<int>(std::lround(memory / time_step));
    Means means;
    double squares = 0.0;
    for (int block = -4; block < blocks; ++block) {
        double share = 0.0, compression = 0.0;
        for (int step = 0; step < steps; ++step) {
            REQUIRE(simulation.step().status == LcpStatus::converged);
            const Rods& rods = simulation.rods();
            const ContactSolution& solution = simulation.contact_solution();
            for (std::size_t k = 0; k < solution.rods.size(); ++k) {
                const std::uint32_t row = solution.rods[k];
                const double force = -dot(solution.forces[k].moment, rods.axis[row]) / rods.length[row] / stall_force;
                compression += force;
                squares += block < 0 ? 0.0 : force * force;
            }
            for (const CellCycle& cycle : rods.cycle) share += cycle.share;
        }
        if (block < 0) continue;
        means.share.push_back(share / static_cast<double>(cells) / steps);
        means.compression.push_back(compression / static_cast<double>(cells) / steps);
    }
    means.largest_bias = time_step / memory * squares / static_cast<double>(cells) / (blocks * steps) / 0.7;
    return means;
}

double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

double standard_error(const std::vector<double>& values) {
    double squares = 0.0;
    for (const double value : values) squares += (value - mean(values)) * (value - mean(values));
    const auto count = static_cast<double>(values.size());
    return std::sqrt(squares / (count * (count - 1.0)));
}

}  // namespace

TEST_CASE("Brownian cells grow by what their mean compression leaves them, whatever the step") {
    // Six standard errors, from 8 blocks: false alarm 5e-4 (Student's t), were the two sides not the same sample.
    const Means coarse = grow(0.02), fine = grow(0.00125);
    for (const Means* means : {&coarse, &fine}) {
        const double error = std::hypot(standard_error(means->share), standard_error(means->compression));
        MESSAGE("share " << mean(means->share) << ", 1 - F/F_stall " << 1.0 - mean(means->compression) << ", +- "
                         << error << ", bias below " << means->largest_bias);
        CHECK(error < 0.015);  // else the next line proves little
        CHECK(std::fabs(mean(means->share) - (1.0 - mean(means->compression))) < 6.0 * error + means->largest_bias);
    }
    const double error = std::hypot(standard_error(coarse.share), standard_error(fine.share));
    CHECK(std::fabs(mean(coarse.share) - mean(fine.share)) < 6.0 * error + coarse.largest_bias);
    CHECK(mean(coarse.share) < 0.8);  // it is about the stall
}
