// Boxes under the pressure of a bath (theory, section 10). Statistical checks allow four standard errors of their own
// sample (false alarm 6e-5 each).

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"

using namespace jostle;

namespace {

Scene scene_of(std::uint64_t count, double pressure, double rms_step) {
    Scene scene;
    scene.rods.count = count;
    scene.rods.length = 0.0;
    scene.time.rms_step = rms_step;
    scene.pressure.external = pressure;
    return scene;
}

/// Mean and error of the volume, its variance, and the mean collision pressure and density; of blocks.
struct Volumes {
    double mean = 0.0, error = 0.0, variance = 0.0, pressure = 0.0, pressure_error = 0.0;
};

Volumes measured(Scene scene, const Box& box, int settling, int blocks, int steps) {
    scene.box.edges = box.edges();
    Simulation simulation = assemble(scene, {box, make_start(scene, box)});
    const auto count = static_cast<double>(simulation.rods().size());
    for (int k = 0; k < settling; ++k) simulation.step();
    std::vector<double> volume, pressure;
    double squares = 0.0;
    for (int block = 0; block < blocks; ++block) {
        double sum = 0.0, virial = 0.0;
        for (int k = 0; k < steps; ++k) {
            const StepReport report = simulation.step();
            REQUIRE(report.status == LcpStatus::converged);
            const double V = simulation.box().volume();
            sum += V / steps;
            squares += V * V / (steps * static_cast<double>(blocks));
            virial += (count + trace(report.collision_virial) / 3.0) / (V * steps);
        }
        volume.push_back(sum);
        pressure.push_back(virial);
    }
    const auto mean_and_error = [&](const std::vector<double>& values) {
        double mean = 0.0, deviation = 0.0;
        for (const double value : values) mean += value / blocks;
        for (const double value : values) deviation += (value - mean) * (value - mean);
        return std::pair{mean, std::sqrt(deviation / (blocks * (blocks - 1.0)))};
    };
    const auto [mean, error] = mean_and_error(volume);
    const auto [mean_pressure, pressure_error] = mean_and_error(pressure);
    return {mean, error, squares - mean * mean, mean_pressure, pressure_error};
}

}  // namespace

TEST_CASE("a dilute gas has the volume of (N + 1) kT/P, and its variance") {
    // Spheres exclude half of 8 volumes each: <V> = (N + 1) kT/P + (N - 1) B_2 to first order.
    const double pressure = 1e-3;
    Scene scene = scene_of(8, pressure, 0.1);
    scene.pressure.relaxation_time = 2.0;
    const double edge = std::cbrt(9.0 / pressure);
    const Volumes gas = measured(scene, Box{{edge, edge, edge}}, 2000, 60, 4000);
    const double exact = 9.0 / pressure + 7.0 * 2.0 * std::numbers::pi / 3.0;
    MESSAGE("<V> = " << gas.mean << " +- " << gas.error << ", exact " << exact << "; variance over exact "
                     << gas.variance * pressure * pressure / 9.0);
    CHECK(gas.error < 0.015 * exact);
    CHECK(std::fabs(gas.mean - exact) < 4.0 * gas.error);
    CHECK(gas.variance == doctest::Approx(9.0 / (pressure * pressure)).epsilon(0.15));
}

TEST_CASE("hard spheres at the pressure that Carnahan and Starling have at 0.3 fill 0.3, and press as the bath does") {
    const double phi = 0.3, pi = std::numbers::pi;
    const double Z = (1.0 + phi + phi * phi - phi * phi * phi) / std::pow(1.0 - phi, 3.0);
    const double pressure = phi * 6.0 / pi * Z;
    CHECK(pressure == doctest::Approx(2.2768).epsilon(1e-4));
    Scene scene = scene_of(256, pressure, 0.05);
    const double edge = std::cbrt(256.0 * pi / 6.0 / 0.25);  // begins at 0.25
    const Volumes fluid = measured(scene, Box{{edge, edge, edge}}, 6000, 30, 1200);
    const double filled = 256.0 * pi / 6.0 / fluid.mean;
    MESSAGE("phi = " << filled << " +- " << filled * fluid.error / fluid.mean << "; pressure over that of the bath "
                     << fluid.pressure / pressure << " +- " << fluid.pressure_error / pressure);
    CHECK(fluid.error < 0.005 * fluid.mean);
    CHECK(std::fabs(filled - phi) < 0.005 * phi + 2.0 * filled * fluid.error / fluid.mean);
    CHECK(std::fabs(fluid.pressure - pressure) < 4.0 * fluid.pressure_error + 0.005 * pressure);
    // n^2 kT d(1/n)/dP of Carnahan and Starling: kT compressibility n = (1 - phi)^4/(1 + 4 phi + 4 phi^2 - 4 phi^3 +
    // phi^4)
    const double n = phi * 6.0 / pi;
    const double exact =
        std::pow(1.0 - phi, 4.0) / (1.0 + 4.0 * phi + 4.0 * phi * phi - 4.0 * phi * phi * phi + std::pow(phi, 4.0));
    MESSAGE("var V n/V = " << fluid.variance * n / fluid.mean << ", Carnahan and Starling " << exact);
    CHECK(fluid.variance * n / fluid.mean == doctest::Approx(exact).epsilon(0.3));
}

TEST_CASE("the strain of one step: of all edges alike, or of each by its own force") {
    using Moves = PressureControl::Moves;
    const PressureControl all = {.external = 0.5, .moves = Moves::volume, .mobility = 0.1};
    const PressureControl each = {.external = 0.5, .moves = Moves::edges, .mobility = 0.1};
    State state;
    state.box = Box{{2, 3, 4}};
    state.rods.push_back(0, {1, 1, 1}, {1, 0, 0}, 0.0, 1.0);
    const StepContext context = {1, 7, 0.01};
    CHECK(edges_under_pressure(state, state.rods.size(), all, 1.0, context).edges == Vec3{2, 3, 4});
    // Noise alone, of a kT too small to be seen in the forces.
    state.box_force = Vec3{30, 60, 90};
    const double kT = 1e-40;
    const Vec3 alike = edges_under_pressure(state, state.rods.size(), all, kT, context).edges;
    const double strain = 0.1 * 0.01 * (60.0 - 0.5 * 24.0);
    for (int k = 0; k < 3; ++k) CHECK(alike[k] == doctest::Approx((2.0 + k) * std::exp(strain / 3.0)).epsilon(1e-14));
    const Vec3 own = edges_under_pressure(state, state.rods.size(), each, kT, context).edges;
    for (int k = 0; k < 3; ++k)
        CHECK(own[k] == doctest::Approx((2.0 + k) * std::exp(0.001 * (30.0 * (k + 1) - 12.0))).epsilon(1e-14));
    const Vec3 noisy = edges_under_pressure(state, state.rods.size(), all, 1.0, context).edges;
    CHECK(noisy.x / 2.0 == doctest::Approx(noisy.y / 3.0).epsilon(1e-14));
    CHECK(noisy != edges_under_pressure(state, state.rods.size(), all, 1.0, {1, 8, 0.01}).edges);
}

TEST_CASE("forces move a box by so much in a step and no more, and the step tells of it") {
    using Moves = PressureControl::Moves;
    State state;
    state.box = Box{{2, 3, 4}, {true, true, false}, {{false, false, true}}};
    state.rods.push_back(0, {1, 1, 1}, {1, 0, 0}, 0.0, 1.0);
    const StepContext context = {1, 7, 0.01};
    const double kT = 1e-40;  // noise too small to be seen
    PressureControl control = {.external = 1e6, .moves = Moves::volume, .mobility = 0.1, .largest_move = 0.03};
    state.box_force = Vec3{30, 60, 90};
    const EdgesUnderPressure squeezed = edges_under_pressure(state, state.rods.size(), control, kT, context);
    CHECK(squeezed.held_back);
    CHECK(Box{squeezed.edges}.volume() == doctest::Approx(24.0 * std::exp(-0.03)).epsilon(1e-14));
    control.external = 0.0;
    state.box_force = Vec3{0, 0, 1e6};
    control.moves = Moves::edges;
    const EdgesUnderPressure stretched = edges_under_pressure(state, state.rods.size(), control, kT, context);
    CHECK(stretched.held_back);
    CHECK(stretched.edges.z == doctest::Approx(4.0 * std::exp(0.03)).epsilon(1e-14));
    CHECK(stretched.edges.x == 2.0);
    state.box_force = Vec3{0, 0, 0.1};
    CHECK_FALSE(edges_under_pressure(state, state.rods.size(), control, kT, context).held_back);
}

TEST_CASE("a piston goes by its load and noise, and contact forces push it in the same step") {
    PressureControl control = {
        .external = 0.5, .moves = PressureControl::Moves::plane, .piston = 2, .mobility = 0.1, .rate = 2.0};
    State state;
    state.box = Box{{2, 3, 4}, {true, true, false}, {{false, false, true}}};
    const StepContext context = {1, 7, 0.01};
    const double load = 0.5 * 6.0, dt = context.time_step;
    const EdgesUnderPressure moved = edges_under_pressure(state, state.rods.size(), control, 1.0, context);
    CHECK(moved.edges.x == 2.0);
    CHECK(moved.edges.y == 3.0);
    CHECK(moved.piston.body == fixed_body(5));
    CHECK(moved.piston.drift == doctest::Approx(-0.1 * load * dt).epsilon(1e-14));
    CHECK(moved.edges.z == doctest::Approx(4.0 + moved.piston.displacement).epsilon(1e-14));
    const double noise = moved.piston.displacement - moved.piston.drift;
    const EdgesUnderPressure colder = edges_under_pressure(state, state.rods.size(), control, 0.25, context);
    CHECK(noise != 0.0);
    CHECK(colder.piston.displacement - colder.piston.drift == doctest::Approx(0.5 * noise).epsilon(1e-12));
    const BoxColumn pushed = opening_of(state.box, control);
    CHECK(pushed.plane == fixed_body(5));
    CHECK(pushed.mobility == 0.1);
    CHECK(opened(state.box.edges(), control, pushed.mobility * load, dt).z ==
          doctest::Approx(4.0 - moved.piston.drift).epsilon(1e-14));
    // Without thermal motion at its full speed, and a force of the load stops it within the step.
    control.mobility = 0.0;
    const EdgesUnderPressure pressed = edges_under_pressure(state, state.rods.size(), control, 0.0, context);
    CHECK_FALSE(pressed.piston.body);
    CHECK(pressed.edges.z == doctest::Approx(4.0 - 0.01 * 2.0).epsilon(1e-14));
    const BoxColumn opening = opening_of(state.box, control);
    CHECK(opening.plane == fixed_body(5));
    CHECK(opened(pressed.edges, control, opening.mobility * load, dt).z == doctest::Approx(4.0).epsilon(1e-14));
}
