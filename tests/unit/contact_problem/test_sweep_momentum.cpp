// How far sweeps are carried on by what the last one changed.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "jostle/contact_problem/sweep_momentum.hpp"

using namespace jostle;

namespace {

/// Gauss-Seidel sweeps over a chain of beads in contact, the first pushed, and the last held. The gap velocities, in
/// units in which every diagonal of A is 1, are gamma_k - (gamma_{k-1} + gamma_{k+1})/2 - push_k. Returns the number
/// of sweeps until no force changes by more than 1e-6.
int sweeps_along_chain(bool with_momentum) {
    constexpr int beads = 40;
    double gamma[beads + 2] = {}, last[beads + 2] = {};
    SweepMomentum momentum;
    for (int sweep = 1; sweep < 100000; ++sweep) {
        const double beta = with_momentum ? momentum.beta() : 0.0;
        double before[beads + 2], start[beads + 2];
        for (int k = 0; k < beads + 2; ++k) {
            before[k] = gamma[k];
            start[k] = gamma[k] += beta * last[k];
        }
        double change = 0.0;
        for (int k = 1; k <= beads; ++k) {
            gamma[k] = std::max(0.5 * (gamma[k - 1] + gamma[k + 1]) + (k == 1 ? 1.0 : 0.0), 0.0);
            last[k] = gamma[k] - before[k];
            change = std::max(change, std::fabs(gamma[k] - start[k]));
        }
        momentum.advance(change);
        REQUIRE(momentum.is_trusted());
        if (change > 1e-6) continue;
        // gamma falls on a straight line: gamma_1 = 2 beads/(beads + 1).
        CHECK(gamma[1] == doctest::Approx(2.0 * beads / (beads + 1.0)).epsilon(1e-3));
        return sweep;
    }
    return 0;
}

}  // namespace

TEST_CASE("beta is 0 at first, then 0.8, and from forty sweeps on 1 - 8/k up to 0.95") {
    SweepMomentum momentum;
    double change = 1.0;
    for (int k = 0; k < 300; ++k) {
        const double expected = k == 0 ? 0.0 : k <= 40 ? 0.8 : k <= 160 ? 1.0 - 8.0 / k : 0.95;
        CHECK(momentum.beta() == doctest::Approx(expected).epsilon(1e-12));
        momentum.advance(change *= 0.98);
    }
}

TEST_CASE("changes that grow a hundredfold begin anew, at the third time for good") {
    SweepMomentum momentum;
    for (int k = 0; k < 3; ++k) {
        CHECK(momentum.is_trusted());
        for (int n = 0; n < 5; ++n) momentum.advance(1.0);
        momentum.advance(99.0);  // single contacts do that
        CHECK(momentum.beta() > 0.0);
        momentum.advance(101.0);
        CHECK(momentum.beta() == 0.0);
    }
    CHECK(!momentum.is_trusted());
}

TEST_CASE("where no change is less than all before for forty sweeps there is less momentum, and in the end none") {
    SweepMomentum momentum;
    double change = 1.0;
    for (const double most : {0.95, 0.9, 0.8, 0.6}) {
        CHECK(momentum.is_trusted());
        for (int k = 0; k < 200; ++k) momentum.advance(change *= 0.98);
        CHECK(momentum.beta() == doctest::Approx(most));
        for (int k = 0; k < 80 && momentum.beta() > 0.0; ++k) momentum.advance(change * (k % 7 == 0 ? 1.0 : 2.0));
        CHECK(momentum.beta() == 0.0);
    }
    CHECK(!momentum.is_trusted());
}

TEST_CASE("contacts that are added may change gaps by anything, and the others keep their momentum") {
    SweepMomentum momentum;
    for (int k = 0; k < 10; ++k) {
        for (int n = 0; n < 5; ++n) momentum.advance(1e-3);
        const double before = momentum.beta();
        momentum.expect_larger_changes();
        CHECK(momentum.beta() == before);
        momentum.advance(1.0);
        CHECK(momentum.beta() >= before);
    }
    CHECK(momentum.is_trusted());
}

TEST_CASE("along a chain momentum saves most of the sweeps") {
    const int without = sweeps_along_chain(false), with = sweeps_along_chain(true);
    MESSAGE("sweeps: ", without, " without, ", with, " with");
    CHECK(with > 0);
    CHECK(10 * with < without);
}
