// A step that is interrupted while its contact forces are sought has not been.

#include <doctest/doctest.h>

#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"
#include "support/simulations.hpp"

using namespace jostle;
using test::check_same_state;

namespace {

constexpr std::uint64_t first_step = 508;  // rows change places at step 512

Scene crowd(SolverMethod method) {
    Scene scene;
    scene.seed = 3;
    scene.rods.count = 60;
    scene.rods.length = 2.0;
    scene.time.rms_step = 0.05;
    scene.solver.method = method;
    return scene;
}

Scene colony() {
    Scene scene;
    scene.seed = 5;
    scene.rods.count = 60;
    scene.rods.length = 2.0;
    scene.fluid.kT = 0.001;
    scene.time.step = 0.01;
    scene.growth.rate = 1.0;
    scene.growth.rate_deviation = 0.1;
    scene.growth.division_length = 5.0;
    scene.growth.division_every = 1;
    return scene;
}

}  // namespace

TEST_CASE("a run of which steps are interrupted and made again has the same bits") {
    const Box box{{9, 9, 9}, {true, true, true}};
    for (const Scene& scene : {crowd(SolverMethod::automatic), crowd(SolverMethod::bbpgd), colony()}) {
        const Rods start = make_start(scene, box, std::nullopt);
        const auto begun = [&] { return assemble(scene, {box, start, {first_step, 0.0}}); };
        Simulation undisturbed = begun(), disturbed = begun();
        int interruptions = 0;
        for (int step = 0; step < 30; ++step) {
            disturbed.interrupt_when([] { return true; });
            while (disturbed.step().status == LcpStatus::interrupted) {
                ++interruptions;
                check_same_state(disturbed, undisturbed);
                disturbed.interrupt_when({});
            }
            REQUIRE(undisturbed.step().status == LcpStatus::converged);
            check_same_state(disturbed, undisturbed);
        }
        CHECK(interruptions > 20);
    }
}
