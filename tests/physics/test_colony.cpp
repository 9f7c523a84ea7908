// A dense colony from one cell, in open space: no step of growth and no division leaves an overlap.

#include <doctest/doctest.h>

#include <algorithm>

#include "jostle/setup/assemble.hpp"
#include "jostle/setup/largest_overlap.hpp"

using namespace jostle;

//     ()  ->  ()()  ->  ...  ->  a ball of 10,000: the inner ones push all others outwards
TEST_CASE("ten thousand cells from one: no overlap above the tolerance after any step of growth or division") {
    Scene scene;
    scene.seed = 2;
    scene.rods.count = 1;
    scene.rods.length = 2.0;
    scene.fluid.kT = 0.001;                     // a little noise lets the line of the first daughters buckle
    scene.contact.brownian_correction = false;  // whose contacts give way to what many neighbours push
    scene.time.step = 0.02;
    scene.growth.rate = 1.0;
    scene.growth.rate_deviation = 0.1;
    scene.growth.division_length = 5.0;
    scene.growth.division_deviation = 0.1;
    Rods rods;
    rods.push_back(0, {500, 500, 500}, {1, 0, 0}, 2.0, 1.0);
    Simulation simulation = assemble(scene, {{{1000, 1000, 1000}, {false, false, false}}, std::move(rods)});
    double largest = 0.0, left = 0.0;
    std::uint64_t births = 0, iterations = 0;
    while (simulation.rods().size() < 10000) {
        const StepReport report = simulation.step();
        REQUIRE(report.status == LcpStatus::converged);
        largest = std::max(largest, report.max_overlap);
        iterations = std::max(iterations, report.iterations);
        births += simulation.lineage().size();
        const bool look = simulation.clock().step % 100 == 0;  // cells divide at every tenth step
        if (look) left = std::max(left, largest_overlap(simulation.rods(), simulation.box()));
    }
    MESSAGE("steps ", simulation.clock().step, ", largest overlap ", left, " after a step, ", largest,
            " within, most sweeps in a step ", iterations);
    CHECK(births == simulation.rods().size() - 1);
    // What is left where forces turn cells far in one step (theory, eq. 2.18), and the solver's tolerance.
    CHECK(left < 0.01 + 1e-4);
    // As a step begins: with rate dt (1 + 4 deviations)/2 from each of two cells.
    CHECK(largest < 0.02 * 1.4 + 0.01 + 1e-4);
}
