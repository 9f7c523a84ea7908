// A change along a series against its correlated fluctuations. Seeds are fixed: these tests give the same on each run.

#include <doctest/doctest.h>

#include <limits>

#include "autoregressive.hpp"
#include "jostle/statistics/drift.hpp"

using namespace jostle;
using namespace jostle::test;

namespace {

constexpr int trials = 400;

/// Share of series of correlation coefficient `phi` plus a straight line by `errors` standard errors of the mean in
/// which a drift is found.
double found_in(std::mt19937_64& generator, std::size_t rows, double phi, double errors) {
    const double change = errors * exact_standard_error(rows, phi);
    double found = 0.0;
    for (int k = 0; k < trials; ++k) {
        std::vector<double> series = autoregressive(generator, rows, phi);
        for (std::size_t t = 0; t < rows; ++t) series[t] += change * static_cast<double>(t) / static_cast<double>(rows);
        found += drift(series).is_significant();
    }
    return found / trials;
}

}  // namespace

TEST_CASE("a drift is found, and none where there is none") {
    std::mt19937_64 generator(71);
    MESSAGE("seed 71");
    for (const auto& [rows, phi] : {std::pair<std::size_t, double>{200, 0.0}, {1000, 0.0}, {2000, 0.8}, {4000, 0.9}}) {
        CAPTURE(rows);
        CAPTURE(phi);
        // One in 70 is expected; 16 of 400, 4 %, once in 10,000.
        CHECK(found_in(generator, rows, phi, 0.0) <= 0.04);
        // A drift by 16 errors of the mean has a slope of 16/sqrt(12) = 4.6 of its own: found in 98 of 100 by an exact
        // error, and nearly so often by one that is measured beside it and widened.
        CHECK(found_in(generator, rows, phi, 16.0) >= 0.85);
    }
}

TEST_CASE("size and error of a known drift") {
    std::mt19937_64 generator(72);
    MESSAGE("seed 72");
    std::vector<double> series = autoregressive(generator, 10000, 0.0);
    for (std::size_t t = 0; t < series.size(); ++t) series[t] += 3.0 * static_cast<double>(t) / 9999.0;
    const Drift found = drift(series);
    const double exact = std::sqrt(12.0 / 10000.0);
    CHECK(std::fabs(found.change - 3.0) < 4.0 * exact);  // false alarm once in 16,000
    CHECK(found.standard_error > 0.9 * exact);
    CHECK(found.standard_error < 1.5 * exact);
    CHECK(found.is_significant());
}

TEST_CASE("lines, constants, and series that are too short or not finite") {
    std::vector<double> line(100), constant(100, 0.1);
    for (std::size_t t = 0; t < line.size(); ++t) line[t] = 0.3 * static_cast<double>(t) + 7.0;
    CHECK(drift(line).change == doctest::Approx(0.3 * 99.0));
    CHECK(drift(line).is_significant());
    CHECK(drift(constant).change == 0.0);
    CHECK(!drift(constant).is_significant());
    CHECK(!drift(std::vector<double>{1, 2, 3}).is_significant());
    line[3] = std::numeric_limits<double>::quiet_NaN();
    CHECK(!drift(line).is_significant());
    CHECK(!drift(std::vector<double>{}).is_significant());
}
