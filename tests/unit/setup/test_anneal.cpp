#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

#include "jostle/setup/anneal.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/largest_overlap.hpp"
#include "jostle/setup/start.hpp"

using namespace jostle;

namespace {

struct Dense {
    Scene scene;
    Box box;
};

Dense dense(std::uint64_t count, double length, double volume_fraction) {
    Dense dense;
    dense.scene.rods.count = count;
    dense.scene.rods.length = length;
    dense.scene.time.rms_step = 0.03;
    const double edge = std::cbrt(static_cast<double>(count) * rod_volume(length, 1.0) / volume_fraction);
    dense.box = Box({edge, edge, edge});
    return dense;
}

/// Mean and standard error, from ten blocks, of Z in the first steps of a run.
std::pair<double, double> first_Z(const Dense& dense, const Rods& rods, int steps) {
    Simulation simulation = assemble(dense.scene, {dense.box, rods});
    double sum = 0.0, squares = 0.0;
    for (int block = 0; block < 10; ++block) {
        double Z = 1.0;
        for (int k = 0; k < steps / 10; ++k)
            Z += trace(simulation.step().collision_virial) / (3.0 * static_cast<double>(rods.size())) * 10.0 / steps;
        sum += 0.1 * Z;
        squares += 0.1 * Z * Z;
    }
    return {sum, std::sqrt((squares - sum * sum) / 9.0)};
}

}  // namespace

// Monte Carlo of 1000 rods has 7.904(22). Pushed apart and shaken only, they begin at 10; what annealing leaves is 5 to
// 8 %.
TEST_CASE("a start of long rods has nearly the pressure of equilibrium from the first step on") {
    // One start differs from another by more than its own error tells, so four are taken together.
    constexpr int starts = 4;
    double sum = 0.0, squares = 0.0;
    for (std::uint64_t seed = 1; seed <= starts; ++seed) {
        Dense rods = dense(300, 10.0, 0.25);
        rods.scene.seed = seed;
        const auto [Z, error] = first_Z(rods, make_start(rods.scene, rods.box), 300);
        MESSAGE("Z = ", Z, " +- ", error);
        CHECK(error < 0.2);
        sum += Z / starts;
        squares += Z * Z / starts;
    }
    const double error = std::sqrt((squares - sum * sum) / (starts - 1));
    CHECK(error < 0.4);
    CHECK(std::fabs(sum - 7.904) < 0.1 * 7.904);
}

TEST_CASE("annealing tells what it does, and ends settled or at its limit") {
    const Dense rods = dense(60, 5.0, 0.3);
    std::vector<Annealing> told;
    const Rods start =
        make_start(rods.scene, rods.box, std::nullopt, [&](const Annealing& now) { told.push_back(now); });
    REQUIRE(told.size() > 500);
    CHECK(told.front().sweeps == 1);
    CHECK(told.front().steps == 0);
    for (std::size_t k = 1; k < told.size(); ++k) {
        CHECK(told[k].sweeps >= told[k - 1].sweeps);
        CHECK(told[k].steps >= told[k - 1].steps);
    }
    const Annealing& last = told.back();
    CHECK(last.was_needed());
    CHECK(last.steps >= 600);
    CHECK((last.settled || last.steps >= max_annealing_steps));
    CHECK(last.Z > 4.0);
    CHECK(last.Z < 12.0);
    CHECK(last.order > 0.0);
    CHECK(largest_overlap(start, rods.box) == 0.0);
}

TEST_CASE("dilute starts are not annealed") {
    const Dense rods = dense(500, 5.0, 0.02);
    make_start(rods.scene, rods.box, std::nullopt, [](const Annealing&) { FAIL("annealed"); });
}

TEST_CASE("annealing stops where the watch throws") {
    const Dense rods = dense(60, 5.0, 0.3);
    const auto stop_after = [&](int steps) {
        make_start(rods.scene, rods.box, std::nullopt, [&](const Annealing& now) {
            if (now.steps == steps) throw std::runtime_error("enough");
        });
    };
    CHECK_THROWS_AS(stop_after(0), std::runtime_error);
    CHECK_THROWS_AS(stop_after(150), std::runtime_error);
}

// Steps are counted in the thinnest diameter, not in that of the first rod.
TEST_CASE("mixtures of thick and thin start without overlap, whoever comes first") {
    const Box box{{9, 9, 9}, {true, true, true}};
    Rods rods;
    for (std::uint64_t id = 0; id < 240; ++id) {
        const double diameter = id < 40 ? 1.9 : 0.9;
        const auto at = [&](std::uint64_t k) {
            return 9.0 * std::fmod(0.37 + 0.754877666 * static_cast<double>(k), 1.0);
        };
        rods.push_back(id, {at(id), at(3 * id + 1), at(7 * id + 2)}, {1, 0, 0}, 0.0, diameter);
    }
    Annealing done;
    const auto watch = [&](const Annealing& now) { done = now; };
    CHECK(anneal(rods, box, 1, watch).apart);
    CHECK(largest_overlap(rods, box) < 1e-12);
    CHECK(done.steps >= 600);
}
