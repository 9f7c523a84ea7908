// Where production starts, for series whose drift is known. Seeds are fixed: these tests give the same on each run.

#include <doctest/doctest.h>

#include <algorithm>

#include "autoregressive.hpp"
#include "jostle/statistics/equilibration.hpp"
#include "jostle/statistics/time_series.hpp"

using namespace jostle;
using namespace jostle::test;

namespace {

/// Noise of variance 1 and correlation coefficient 0.9 on `size` exp(-t/decay).
std::vector<double> relaxing(std::mt19937_64& generator, std::size_t rows, double size, double decay) {
    std::vector<double> series = autoregressive(generator, rows, 0.9);
    for (std::size_t k = 0; k < rows; ++k) series[k] += size * std::exp(-static_cast<double>(k) / decay);
    return series;
}

}  // namespace

TEST_CASE("a stationary series is kept") {
    std::mt19937_64 generator(41);
    MESSAGE("seed 41");
    constexpr int trials = 24;
    constexpr std::size_t rows = 10000;
    std::vector<std::size_t> starts;
    int reached = 0;
    for (int k = 0; k < trials; ++k) {
        const Equilibration found = detect_equilibration(autoregressive(generator, rows, k % 2 == 0 ? 0.0 : 0.9));
        starts.push_back(found.start);
        reached += found.reached;
    }
    std::sort(starts.begin(), starts.end());
    // Chance discards more than a twentieth in one of about 10 series; 10 or more of 24 once in 10,000.
    CHECK(starts[trials - 10] < rows / 20);
    CHECK(reached == trials);
}

TEST_CASE("a drift that dies out is cut off, and little more") {
    std::mt19937_64 generator(42);
    MESSAGE("seed 42");
    constexpr std::size_t rows = 10000;
    constexpr double decay = 300.0;
    for (int k = 0; k < 10; ++k) {
        const std::vector<double> series = relaxing(generator, rows, 5.0, decay);
        const Equilibration found = detect_equilibration(series);
        // At 1 decay time the drift is twice the noise, at 7 it is 0.005 of it, far below the error of the mean, 0.05.
        CHECK(found.start > static_cast<std::size_t>(decay));
        CHECK(found.start < static_cast<std::size_t>(7.0 * decay));
        CHECK(found.reached);
        // Worth some 500; the largest error of the levels may make it a quarter of that.
        CHECK(average(std::span(series).subspan(found.start)).effective_samples > 100.0);
    }
}

TEST_CASE("a drift over the whole series is not called equilibrium") {
    std::mt19937_64 generator(43);
    MESSAGE("seed 43");
    for (int k = 0; k < 10; ++k) {
        std::vector<double> ramp = autoregressive(generator, 5000, 0.5);
        for (std::size_t t = 0; t < ramp.size(); ++t) ramp[t] += 10.0 * static_cast<double>(t) / 5000.0;
        const Equilibration found = detect_equilibration(ramp);
        CHECK(!found.reached);
        CHECK(found.start <= ramp.size() / 2);
    }
}

TEST_CASE("a slow drift, no larger than the noise, is called equilibrium at most now and then") {
    std::mt19937_64 generator(45);
    MESSAGE("seed 45");
    int reached = 0;
    for (int k = 0; k < 20; ++k) {
        std::vector<double> ramp = autoregressive(generator, 5000, 0.8);
        for (std::size_t t = 0; t < ramp.size(); ++t) ramp[t] += 3.0 * static_cast<double>(t) / 5000.0;
        reached += detect_equilibration(ramp).reached;
    }
    CHECK(reached <=
          2);  // measured: 4 of 500, so 3 of 20 has the chance 5e-4; a limit at the half would pass half of them
}

TEST_CASE("constant, short and empty series") {
    const Equilibration constant = detect_equilibration(std::vector<double>(500, 3.0));
    CHECK(constant.start == 0);
    CHECK(constant.reached);
    std::vector<double> step(400, 1.0);
    std::fill(step.begin(), step.begin() + 100, 0.0);  // then constant for ever
    CHECK(detect_equilibration(step).start == 100);
    CHECK(!detect_equilibration(std::vector<double>{1, 2, 3}).reached);
    CHECK(!detect_equilibration(std::vector<double>{}).reached);
}
