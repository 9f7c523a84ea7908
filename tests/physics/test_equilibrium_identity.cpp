// The geometric part of the collision stress of passive rods in equilibrium is known exactly (theory, section 1):
//     (1/V) <sum of s^G> = 2 n kT B Q,
// so the principal stresses of a nematic follow from Z and the order tensor, without any fit.

#include <doctest/doctest.h>

#include <cmath>

#include "jostle/math/symmetric_eigen.hpp"
#include "jostle/simulation/assemble.hpp"
#include "jostle/simulation/start.hpp"
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
    scene.time.rms_step = 0.1;
    const double volume = 300.0 * rod_volume(5.0, 1.0) / 0.45;
    const double edge = std::cbrt(volume / 2.0);
    const Box box{{2.0 * edge, edge, edge}, {true, true, true}};
    scene.contact.brownian_correction = false;
    // Large steps take the perfectly aligned start to a nematic; their error is forgotten in the steps that follow.
    Simulation fast = assemble(scene, box, make_start(scene, box), {});
    for (int step = 0; step < 900; ++step) REQUIRE(fast.step().status == LcpStatus::converged);
    scene.time.rms_step = 0.03;
    scene.contact.brownian_correction = true;
    Simulation simulation = assemble(scene, box, fast.rods(), fast.clock());

    // Columns: Sigma_col V/(N kT) along and across the mean director (x), and the order tensor's xx, averaged over 10
    // steps.
    const double B = moment_anisotropy(5.0);
    std::vector<std::vector<double>> columns(3);
    for (int row = 0; row < 560; ++row) {
        Mat3 virial;
        double order = 0.0;
        for (int step = 0; step < 10; ++step) {
            order += 0.1 * nematic_order(simulation.rods().axis).tensor(0, 0);
            const StepReport report = simulation.step();
            REQUIRE(report.status == LcpStatus::converged);
            virial += (0.1 / 300.0) * report.collision_virial;
        }
        if (row < 60) continue;
        columns[0].push_back(virial(0, 0));
        columns[1].push_back(0.5 * (virial(1, 1) + virial(2, 2)));
        columns[2].push_back(order);
    }
    // Sigma_xx - Sigma_perp = n kT 2 B (Q_xx - Q_perp) = n kT 3 B Q_xx.
    const Estimate difference = jackknife(
        columns, [B](std::span<const double> mean) { return (mean[0] - mean[1]) / (3.0 * B * mean[2]) - 1.0; });
    const Estimate order = jackknife(columns, [](std::span<const double> mean) { return mean[2]; });
    REQUIRE(difference.standard_error.has_value());
    MESSAGE("Q_xx = ", order.value, ", stress difference over prediction - 1 = ", difference.value, " +- ",
            *difference.standard_error);
    CHECK(order.value > 0.5);
    CHECK(*difference.standard_error < 0.08);
    // Four standard errors: false alarm 6e-5; and the time step's own bias, at most 2 % here.
    CHECK(std::fabs(difference.value) < 4.0 * *difference.standard_error + 0.02);
}
