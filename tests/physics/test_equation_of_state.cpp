// Z of isotropic rods and spheres at rms step 0.03 D against independent values: Carnahan-Starling for spheres, Monte
// Carlo of hard spherocylinders (N = 1000; provenance: studies/reference/README.md) for rods. Each point must lie
// within 1 % plus two standard errors, of both sides together.

#include <doctest/doctest.h>

#include <cmath>

#include "jostle/simulation/assemble.hpp"
#include "jostle/simulation/start.hpp"
#include "jostle/statistics/time_series.hpp"

using namespace jostle;

namespace {

constexpr int steps_per_row = 10;

struct State {
    double aspect_ratio, volume_fraction, Z, Z_error;
    int equilibration_rows, production_rows;
};

double carnahan_starling(double phi) {
    return (1 + phi + phi * phi - phi * phi * phi) / std::pow(1 - phi, 3);
}

Average measured_Z(const State& state) {
    Scene scene;
    scene.seed = 20261120;
    scene.rods.count = 600;
    scene.rods.length = state.aspect_ratio;
    scene.time.rms_step = 0.03;
    const double volume = 600.0 * rod_volume(state.aspect_ratio, 1.0) / state.volume_fraction;
    const Box box{Vec3{1, 1, 1} * std::cbrt(volume), {true, true, true}};
    Simulation simulation = assemble(scene, box, make_start(scene, box), {});
    std::vector<double> rows;
    for (int row = 0; row < state.equilibration_rows + state.production_rows; ++row) {
        double virial = 0.0;
        for (int step = 0; step < steps_per_row; ++step) {
            const StepReport report = simulation.step();
            REQUIRE(report.status == LcpStatus::converged);
            virial += trace(report.collision_virial) / steps_per_row;
        }
        if (row >= state.equilibration_rows) rows.push_back(1.0 + virial / (3.0 * 600.0));
    }
    return average(rows);
}

}  // namespace

TEST_CASE("Z agrees with published and recomputed values within 1 % plus two standard errors") {
    const std::vector<State> states = {
        {0, 0.10, carnahan_starling(0.10), 0.0, 60, 400},
        {0, 0.20, carnahan_starling(0.20), 0.0, 60, 300},
        {0, 0.30, carnahan_starling(0.30), 0.0, 60, 200},
        {2, 0.20, 3.0595, 0.0037, 100, 250},
        {5, 0.05, 1.4997, 0.0016, 100, 400},
        {5, 0.10, 2.1770, 0.0037, 100, 300},
        {5, 0.20, 4.2657, 0.0109, 200, 300},
        {10, 0.10, 2.9090, 0.0033, 150, 600},
    };
    for (const State& state : states) {
        const Average Z = measured_Z(state);
        REQUIRE(Z.standard_error.has_value());
        const double error = std::hypot(*Z.standard_error, state.Z_error);
        MESSAGE("L/D ", state.aspect_ratio, " phi ", state.volume_fraction, ": Z = ", Z.mean, " +- ", *Z.standard_error,
                ", expected ", state.Z, ", difference ", 100.0 * (Z.mean / state.Z - 1.0), " %");
        CHECK(*Z.standard_error < 0.012 * state.Z);  // or the comparison would say nothing
        CHECK(std::fabs(Z.mean - state.Z) <= 0.01 * state.Z + 2.0 * error);
    }
}
