// Z of isotropic rods and spheres at rms step 0.03 D against independent values: Carnahan-Starling for spheres, Monte
// Carlo of hard spherocylinders (N = 1000; provenance: studies/reference/README.md) for rods. Each point must lie
// within 1 % plus two standard errors, of both sides together.

#include <doctest/doctest.h>

#include <cmath>

#include "jostle/scene/rod_size.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"
#include "jostle/statistics/time_series.hpp"

using namespace jostle;

namespace {

constexpr int steps_per_row = 10;

struct StatePoint {
    double aspect_ratio, volume_fraction, Z, Z_error;
    int equilibration_rows, production_rows;
    double diameter_deviation = 0.0, rms_step = 0.03;
};

double carnahan_starling(double phi) {
    return (1 + phi + phi * phi - phi * phi * phi) / std::pow(1 - phi, 3);
}

/// Spheres of many diameters (Boublik, J. Chem. Phys. 53, 471 (1970); Mansoori et al., ibid. 54, 1523 (1971)), for
/// those of the scene; Carnahan-Starling where they are alike.
double mixture(const Scene& scene) {
    double m1 = 0.0, m2 = 0.0, m3 = 0.0;
    for (const RodSize& size : rod_sizes(scene)) {
        const double d = size.diameter, share = 1.0 / static_cast<double>(scene.rods.count);
        m1 += share * d;
        m2 += share * d * d;
        m3 += share * d * d * d;
    }
    const double phi = *scene.box.volume_fraction, room = 1.0 - phi;
    return 1.0 / room + 3.0 * phi / (room * room) * m1 * m2 / m3 +
           phi * phi * (3.0 - phi) / (room * room * room) * m2 * m2 * m2 / (m3 * m3);
}

Scene scene_of(const StatePoint& state) {
    Scene scene;
    scene.seed = 20261120;
    scene.box.volume_fraction = state.volume_fraction;
    scene.rods.count = 600;
    scene.rods.length = state.aspect_ratio;
    scene.rods.diameter_deviation = state.diameter_deviation;
    scene.time.rms_step = state.rms_step;
    return scene;
}

Average measured_Z(const StatePoint& state) {
    const Scene scene = scene_of(state);
    const Box box{box_edges(scene), {true, true, true}};
    Simulation simulation = assemble(scene, {box, make_start(scene, box)});
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

void check(const StatePoint& state) {
    const Average Z = measured_Z(state);
    REQUIRE(Z.standard_error.has_value());
    const double error = std::hypot(*Z.standard_error, state.Z_error);
    MESSAGE("L/D ", state.aspect_ratio, " phi ", state.volume_fraction, ": Z = ", Z.mean, " +- ", *Z.standard_error,
            ", expected ", state.Z, ", difference ", 100.0 * (Z.mean / state.Z - 1.0), " %");
    CHECK(*Z.standard_error < 0.012 * state.Z);  // or the comparison would say nothing
    CHECK(std::fabs(Z.mean - state.Z) <= 0.01 * state.Z + 2.0 * error);
}

}  // namespace

TEST_CASE("Z agrees with published and recomputed values within 1 % plus two standard errors") {
    const std::vector<StatePoint> states = {
        {0, 0.10, carnahan_starling(0.10), 0.0, 60, 400},
        {0, 0.20, carnahan_starling(0.20), 0.0, 60, 300},
        {0, 0.30, carnahan_starling(0.30), 0.0, 60, 400},
        {2, 0.20, 3.0595, 0.0037, 100, 1200},
        {5, 0.05, 1.4997, 0.0016, 100, 800},
        {5, 0.10, 2.1770, 0.0037, 100, 1200},
        {5, 0.20, 4.2657, 0.0109, 200, 1400},
        {10, 0.10, 2.9090, 0.0033, 150, 1200},
    };
    for (const StatePoint& state : states) check(state);
}

TEST_CASE("spheres of many diameters have the Z of their mixture, which is not that of spheres alike") {
    // rms step in diameters of the smallest, 0.55
    StatePoint state = {0, 0.30, 0.0, 0.0, 60, 600, 0.15, 0.06};
    state.Z = mixture(scene_of(state));
    CHECK(state.Z < 0.97 * carnahan_starling(0.30));
    check(state);
    state.diameter_deviation = 0.0;
    CHECK(mixture(scene_of(state)) == doctest::Approx(carnahan_starling(0.30)));
}
