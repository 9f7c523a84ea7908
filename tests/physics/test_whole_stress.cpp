// The whole stress of Brownian rods, kinetic + orientation + collision (theory, eq. 1.19), where it is known exactly:
// isotropic in a fluid in equilibrium, whatever the shapes of the rods; and that of one rod which meets its own image.

#include <doctest/doctest.h>

#include <cmath>

#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"
#include "jostle/statistics/jackknife.hpp"
#include "jostle/statistics/order_parameter.hpp"
#include "jostle/stress/orientation_stress.hpp"

using namespace jostle;

namespace {

/// V Sigma/(N kT) on the diagonal, x and the mean of y and z: of the whole stress and without its orientation part; and
/// <n_x^2>. Columns are means over rows of steps.
enum : std::size_t { whole_along, whole_across, collision_along, collision_across, order_along, quantities };

std::vector<std::vector<double>> measured(Simulation& simulation, int rows, int steps_a_row) {
    std::vector<std::vector<double>> columns(quantities);
    const double N = static_cast<double>(simulation.rods().size());
    const auto across = [](const Mat3& tensor) { return 0.5 * (tensor(1, 1) + tensor(2, 2)); };
    for (int row = 0; row < rows; ++row) {
        Mat3 collision;
        for (int step = 0; step < steps_a_row; ++step) {
            const StepReport report = simulation.step();
            REQUIRE(report.status == LcpStatus::converged);
            collision += (1.0 / (N * steps_a_row)) * report.collision_virial;
        }
        const Mat3 without = identity() + collision;
        const Mat3 whole = without + (1.0 / N) * sum_of_orientation_stresses(simulation.rods(), 1.0);
        const double order = nematic_order(simulation.rods().axis).tensor(0, 0);
        const double values[] = {whole(0, 0), across(whole), without(0, 0), across(without), (1.0 + 2.0 * order) / 3.0};
        for (std::size_t k = 0; k < quantities; ++k) columns[k].push_back(values[k]);
    }
    return columns;
}

Estimate mean_of(const std::vector<std::vector<double>>& columns, std::size_t column) {
    return jackknife(columns, [&](std::span<const double> mean) { return mean[column]; });
}

}  // namespace

// A rod longer than the box is wide meets its own image unless it lies across: with q = (D/E)^2, E the width along x,
// n_x is uniform between -sqrt(1 - q) and sqrt(1 - q). The free energy -kT ln(V sqrt(1 - q)) gives
// V Sigma = kT diag(1/(1 - q), 1, 1).
TEST_CASE("one rod that meets its own image: the exact stress along and across") {
    Scene scene;
    scene.seed = 5;
    MESSAGE("seed 5");
    scene.rods.count = 1;
    scene.rods.length = 1.5;
    scene.time.rms_step = 0.03;
    Rods rods;
    rods.push_back(0, {0.5, 2, 2}, {0, 0, 1}, 1.5, 1.0);
    const double q = 1.0 / (1.5 * 1.5);
    Simulation simulation = assemble(scene, {{{1.5, 6, 6}, {true, true, true}}, rods});
    const auto columns = measured(simulation, 6000, 100);
    const double exact[] = {1.0 / (1.0 - q), 1.0};
    for (const std::size_t column : {whole_along, whole_across}) {
        const Estimate found = mean_of(columns, column);
        REQUIRE(found.standard_error.has_value());
        MESSAGE(found.value, " +- ", *found.standard_error, ", exact ", exact[column]);
        // Four standard errors: false alarm 6e-5; and the time step's own bias, at most 2 %.
        CHECK(std::fabs(found.value - exact[column]) < 4.0 * *found.standard_error + 0.02 * exact[column]);
    }
    // Without the orientation stress it would be 1/(1 - q) - B q along and 1 + B q/2 = 1.17 across.
    const Estimate across = mean_of(columns, collision_across);
    CHECK(across.value - 1.0 > 8.0 * *across.standard_error);
    const Estimate order = mean_of(columns, order_along);
    CHECK(std::fabs(order.value - (1.0 - q) / 3.0) < 4.0 * *order.standard_error + 0.02);
}

TEST_CASE("a rod alone: the orientation stress vanishes in the mean, and the whole stress is that of an ideal gas") {
    Scene scene;
    scene.seed = 6;
    MESSAGE("seed 6");
    scene.rods.count = 1;
    scene.rods.length = 1.5;
    scene.time.rms_step = 0.06;
    Simulation simulation =
        assemble(scene, {{{6, 6, 6}, {true, true, true}}, make_start(scene, {{6, 6, 6}, {true, true, true}})});
    const auto columns = measured(simulation, 4000, 50);
    for (const std::size_t column : {whole_along, whole_across}) {
        const Estimate found = mean_of(columns, column);
        REQUIRE(found.standard_error.has_value());
        MESSAGE(found.value, " +- ", *found.standard_error);
        CHECK(*found.standard_error < 0.1);
        CHECK(std::fabs(found.value - 1.0) < 4.0 * *found.standard_error);
    }
}

// Rods of two lengths, each with its own B: eq. (1.8), which needs one B, says nothing here.
TEST_CASE("a nematic of rods of two lengths pushes alike in all directions") {
    Scene scene;
    scene.seed = 7;
    MESSAGE("seed 7");
    scene.rods.count = 300;
    scene.rods.length = 6.0;
    scene.rods.start = StartKind::aligned;
    const double edge = std::cbrt(300.0 * rod_volume(6.0, 1.0) / 0.48 / 2.0);
    const Box box{{2.0 * edge, edge, edge}, {true, true, true}};
    Rods rods = make_start(scene, box);
    for (std::size_t i = 0; i < rods.size(); i += 2) rods.length[i] = 5.0;  // volume fraction 0.44
    // Large steps take the perfectly aligned start to a nematic; their error is forgotten in the steps that follow.
    scene.time.rms_step = 0.1;
    Simulation fast = assemble(scene, {box, std::move(rods)});
    for (int step = 0; step < 1000; ++step) REQUIRE(fast.step().status == LcpStatus::converged);
    scene.time.rms_step = 0.05;
    Simulation simulation = assemble(scene, fast.state());
    for (int step = 0; step < 500; ++step) REQUIRE(simulation.step().status == LcpStatus::converged);
    const auto columns = measured(simulation, 1300, 10);
    const auto ratio_less_1 = [&](std::size_t along, std::size_t across) {
        return jackknife(columns, [&](std::span<const double> mean) { return mean[along] / mean[across] - 1.0; });
    };
    const Estimate order = mean_of(columns, order_along);
    const Estimate whole = ratio_less_1(whole_along, whole_across);
    const Estimate without = ratio_less_1(collision_along, collision_across);
    REQUIRE_MESSAGE(whole.standard_error.has_value(), whole.no_error_reason);
    REQUIRE_MESSAGE(without.standard_error.has_value(), without.no_error_reason);
    MESSAGE("<n_x^2> = ", order.value, ", along over across less 1: ", whole.value, " +- ", *whole.standard_error,
            ", without the orientation stress ", without.value, " +- ", *without.standard_error);
    CHECK(order.value > 0.7);
    CHECK(*whole.standard_error < 0.02);
    // Four standard errors: false alarm 6e-5; and the time step's own bias, at most 2 % here.
    CHECK(std::fabs(whole.value) < 4.0 * *whole.standard_error + 0.02);
    CHECK(without.value > 8.0 * *without.standard_error);
}
