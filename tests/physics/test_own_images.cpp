// One Brownian rod in a box hardly wider than it: it turns between its own images. With E the edge, its axis n is
// uniform where they do not overlap, |n_x| < sin(a), so that exactly (theory, section 3)
//     Z = 1 + (d ln sin(a)/d ln E)/3;  side by side sin(a)^2 = 1 - q, q = (D/E)^2, and Z = 1 + q/(3 (1 - q)).
// Every Z is allowed five standard errors, from 50 blocks of its own sample: false alarm 8e-6 each (Student's t).

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "jostle/setup/assemble.hpp"
#include "support/sample.hpp"

using namespace jostle;

namespace {

struct Case {
    double edge, rms_step, length;
    double precision;  ///< of Z - 1 that the sample must reach, else its mean proves little
    int steps = 2000;  ///< of each of 50 blocks
};

double exact(double edge, double length) {
    const double q = 1.0 / (edge * edge);
    const bool side_by_side = edge * edge - 1.0 <= length * length;
    const double slope = side_by_side ? q / (1.0 - q) : 2.0 * edge * edge / (edge * edge + length * length - 1.0) - 1.0;
    return 1.0 + slope / 3.0;
}

struct Measured {
    double Z = 0.0, standard_error = 0.0, largest_overlap = 0.0;
};

Measured measure(const Case& test) {
    constexpr int blocks = 50;
    const int steps = test.steps;
    Scene scene;
    scene.rods.count = 1;
    scene.rods.length = test.length;
    scene.time.rms_step = test.rms_step;
    Rods rods;
    rods.push_back(0, {0.5, 6, 6}, {0, 0, 1}, test.length, 1.0);
    Simulation simulation = assemble(scene, {{{test.edge, 12, 12}, {true, true, true}}, rods});
    std::vector<double> block;
    Measured result;
    for (int k = -1; k < blocks; ++k) {
        double sum = 0.0;
        for (int step = 0; step < steps; ++step) {
            const StepReport report = simulation.step();
            REQUIRE(report.status == LcpStatus::converged);
            sum += trace(report.collision_virial) / 3.0;
            result.largest_overlap = std::max(result.largest_overlap, report.max_overlap);
        }
        if (k >= 0) block.push_back(1.0 + sum / steps);
    }
    const test::Sample sample(block);
    result.Z = sample.mean;
    result.standard_error = sample.error;
    return result;
}

}  // namespace

TEST_CASE("a rod that turns between its own images has the exact Z, at small and large steps") {
    for (const Case& test : {Case{1.001, 0.03, 5.0, 0.03},
                             {1.005, 0.03, 5.0, 0.06},
                             {1.02, 0.03, 5.0, 0.12},
                             {1.2, 0.03, 5.0, 0.3},
                             {1.001, 0.1, 5.0, 0.01, 3000},
                             {1.005, 0.1, 5.0, 0.015},
                             {1.02, 0.1, 5.0, 0.03},
                             {1.2, 0.1, 5.0, 0.1},
                             {1.02, 0.06, 0.74, 0.015},
                             {1.001, 0.03, 0.74, 0.01},
                             {1.4, 0.06, 0.74, 0.1}}) {
        CAPTURE(test.edge);
        CAPTURE(test.rms_step);
        CAPTURE(test.length);
        const Measured measured = measure(test);
        const double expected = exact(test.edge, test.length);
        MESSAGE("exact " << expected << ", found " << measured.Z << " +- " << measured.standard_error);
        CHECK(std::fabs(measured.Z - expected) < 5.0 * measured.standard_error);
        CHECK(measured.standard_error < test.precision * (expected - 1.0));
        CHECK(measured.largest_overlap < 0.03);  // the bound that a step keeps (decision 0061)
    }
}
