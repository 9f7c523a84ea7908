// The geometric part of the collision stress of passive rods in equilibrium is known exactly (theory, section 1):
//     (1/V) <sum of s^G> = 2 n kT B Q,
// so the principal stresses of a nematic follow from Z and the order tensor, without any fit. At finite time steps it
// holds where the stress is that of rods half way through their collisions (theory, eq. 3.7): at the axes before the
// step it would be a fifth too small here.

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>

#include "jostle/math/symmetric_eigen.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"
#include "jostle/statistics/jackknife.hpp"
#include "jostle/statistics/order_parameter.hpp"
#include "jostle/stress/spherocylinder_moments.hpp"

using namespace jostle;

TEST_CASE("the stress anisotropy of a nematic is that of Z and the order tensor") {
    Scene scene;
    scene.seed = 5;
    scene.rods.count = 300;
    scene.rods.length = 5.0;
    scene.rods.start = StartKind::aligned;
    scene.output.stress_conventions = true;
    const double volume = 300.0 * rod_volume(5.0, 1.0) / 0.45;
    const double edge = std::cbrt(volume / 2.0);
    const Box box{{2.0 * edge, edge, edge}, {true, true, true}};
    // Large steps take the perfectly aligned start to a nematic; their error is forgotten in the steps that follow.
    scene.time.rms_step = 0.1;
    Simulation fast = assemble(scene, {box, make_start(scene, box)});
    for (int step = 0; step < 900; ++step) REQUIRE(fast.step().status == LcpStatus::converged);
    scene.time.rms_step = 0.05;
    Simulation simulation = assemble(scene, fast.state());

    // Columns: normal difference, along the mean director (x) less across it, of the stress and of its geometric part,
    // V Sigma/(N kT), and the order tensor's xx, averaged over 10 steps.
    const auto normal_difference = [](const Mat3& m) { return m(0, 0) - 0.5 * (m(1, 1) + m(2, 2)); };
    const double B = moment_anisotropy(5.0);
    std::vector<std::vector<double>> columns(3);
    for (int row = 0; row < 1560; ++row) {
        Mat3 stress, geometric;
        double order = 0.0;
        for (int step = 0; step < 10; ++step) {
            order += 0.1 * nematic_order(simulation.rods().axis).tensor(0, 0);
            const StepReport report = simulation.step();
            REQUIRE(report.status == LcpStatus::converged);
            stress += (0.1 / 300.0) * report.collision_virial;
            geometric += (0.1 / 300.0) * (report.collision_virial - report.centre_of_mass_virial);
        }
        if (row < 60) continue;
        columns[0].push_back(normal_difference(stress));
        columns[1].push_back(normal_difference(geometric));
        columns[2].push_back(order);
    }
    // Q_xx - Q_perp = 3/2 Q_xx, so n kT 2 B (Q_xx - Q_perp) = n kT 3 B Q_xx.
    const auto over_prediction = [&](std::size_t column) {
        return jackknife(columns,
                         [&](std::span<const double> mean) { return mean[column] / (3.0 * B * mean[2]) - 1.0; });
    };
    const Estimate order = jackknife(columns, [](std::span<const double> mean) { return mean[2]; });
    CHECK(order.value > 0.5);
    const std::array<std::string, 2> name = {"stress", "geometric stress"};
    const std::array<double, 2> largest_error = {0.08, 0.02};
    for (const std::size_t column : {0U, 1U}) {
        const Estimate difference = over_prediction(column);
        REQUIRE(difference.standard_error.has_value());
        MESSAGE("Q_xx = ", order.value, ", normal difference of the ", name[column],
                " over prediction - 1 = ", difference.value, " +- ", *difference.standard_error);
        CHECK(*difference.standard_error < largest_error[column]);
        // Four standard errors: false alarm 6e-5; and the time step's own bias, at most 2 % here.
        CHECK(std::fabs(difference.value) < 4.0 * *difference.standard_error + 0.02);
    }
}
