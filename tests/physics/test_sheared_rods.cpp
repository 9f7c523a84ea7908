// Exact relations of rods in a steady shear flow (theory, section 8). Statistical checks allow four standard errors of
// their own sample (false alarm 6e-5 each).

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

#include "jostle/math/shear_rotation.hpp"
#include "jostle/simulation/flow_stress.hpp"
#include "jostle/statistics/time_series.hpp"
#include "jostle/stress/orientation_stress.hpp"
#include "jostle/stress/spherocylinder_moments.hpp"
#include "support/sample.hpp"
#include "support/simulations.hpp"

using namespace jostle;
using test::Sample;
using test::started;

namespace {

Scene sheared(std::uint64_t count, double length, double volume_fraction) {
    Scene scene;
    scene.seed = 23;
    scene.box.volume_fraction = volume_fraction;
    scene.rods.count = count;
    scene.rods.length = length;
    return scene;
}

double rotational_mobility(const Simulation& simulation) {
    return simulation.mobility().at(simulation.rods(), simulation.box())->of_rod(0).rotational;
}

}  // namespace

// 3000 rods that do not meet, each a sample of its own. Axes are looked at half way through the turn by the flow of a
// step, where the error of a step is of second order.
TEST_CASE("free rods in a shear flow have the moments of Smoluchowski's equation") {
    // Solved by spherical harmonics up to l = 44 (theory, section 8).
    constexpr double Pe = 5.0, nxny = 0.097496, nxnx = 0.416713, nyny = 0.271259;
    Scene scene = sheared(3000, 5.0, 1e-9);
    scene.time.step = 1.0;
    double diffusion = 0.0;
    {
        Scene still = scene;
        still.time.step = 1e-3;
        diffusion = rotational_mobility(started(still));
    }
    scene.time.step = 0.004 / diffusion;
    scene.flow.shear_rate = Pe * diffusion;
    Simulation simulation = started(scene);
    const double strain = 0.004 * Pe;
    const ShearRotation half_way(0.5 * strain, moment_anisotropy(5.0));
    constexpr int before = 500, steps = 12500, every = 25;
    std::array<std::vector<double>, 3> sums;
    for (auto& sum : sums) sum.assign(scene.rods.count, 0.0);
    for (int step = 0; step < before + steps; ++step) {
        REQUIRE(simulation.step().status == LcpStatus::converged);
        if (step < before || step % every != 0) continue;
        const Rods& rods = simulation.rods();
        for (std::size_t i = 0; i < rods.size(); ++i) {
            const Vec3 n = half_way.of(rods.axis[i]);
            const std::array<double, 3> moments = {n.x * n.y, n.x * n.x, n.y * n.y};
            for (std::size_t k = 0; k < 3; ++k) sums[k][rods.id[i]] += moments[k] * every / steps;
        }
    }
    const Sample xy(sums[0]), xx(sums[1]), yy(sums[2]);
    MESSAGE("<n_x n_y> = ", xy.mean, " +- ", xy.error, ", ", nxny, "; <n_x^2> = ", xx.mean, " +- ", xx.error, ", ",
            nxnx, "; <n_y^2> = ", yy.mean, " +- ", yy.error, ", ", nyny);
    CHECK(xy.error < 0.01 * nxny);
    CHECK(xy.agrees_with(nxny));
    CHECK(xx.agrees_with(nxnx));
    CHECK(yy.agrees_with(nyny));
}

TEST_CASE("at a moderate density geometric and orientation stress are what the flow turns the axes by") {
    Scene scene = sheared(250, 3.0, 0.2);
    scene.time.rms_step = 0.05;
    Scene still = scene;
    const double diffusion = rotational_mobility(started(still));
    scene.flow.shear_rate = 6.0 * diffusion;
    Simulation simulation = started(scene);
    constexpr int before = 4000, steps = 48000, a_row = 20;
    std::array<std::vector<double>, 6> differences, turning;
    std::array<double, 6> difference{}, left{};
    for (int step = 0; step < before + steps; ++step) {
        const StepReport report = simulation.step();
        REQUIRE(report.status == LcpStatus::converged);
        if (step < before) continue;
        const Mat3 geometric = report.collision_virial - report.centre_of_mass_virial;
        const auto mobility = simulation.mobility().at(simulation.rods(), simulation.box());
        const Mat3 orientation = sum_of_orientation_stresses(simulation.rods(), 1.0);
        const Mat3 flow = sum_of_flow_stresses(simulation.rods(), *mobility, *simulation.settings().flow,
                                               simulation.clock(), simulation.settings().time_step);
        constexpr std::array<int, 6> row = {0, 0, 0, 1, 1, 2}, column = {0, 1, 2, 1, 2, 2};
        for (std::size_t k = 0; k < 6; ++k) {
            const int a = row[k], b = column[k];
            const double both = 0.5 * (geometric(a, b) + geometric(b, a)) + orientation(a, b);
            left[k] += both / a_row;
            difference[k] += (both - flow(a, b)) / a_row;
        }
        if ((step + 1) % a_row != 0) continue;
        for (std::size_t k = 0; k < 6; ++k) {
            turning[k].push_back(left[k]);
            differences[k].push_back(difference[k]);
        }
        left = difference = {};
    }
    const double shear = average(turning[1]).mean;
    for (std::size_t k = 0; k < 6; ++k) {
        const Average apart = average(differences[k]);
        REQUIRE(apart.standard_error);
        MESSAGE("element ", k, " of 6: ", average(turning[k]).mean, ", off by ", apart.mean, " +- ",
                *apart.standard_error);
        CHECK(std::fabs(apart.mean) < 4.0 * *apart.standard_error);
        CHECK(*apart.standard_error < 0.1 * std::fabs(shear));
    }
    CHECK(shear < 0.0);  // the flow is slowed down
}
