// Integrals of autocorrelations, against series for which they are known.

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "autoregressive.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/statistics/correlation_integral.hpp"

using namespace jostle;
using namespace jostle::test;

namespace {

using Columns = std::vector<std::vector<double>>;

/// 1/2 + sum of phi^k.
double exact_integral(double phi) {
    return 0.5 + phi / (1.0 - phi);
}

double of_time(double time) {
    return std::exp(-1.0 / time);
}

/// One mode of a series: `share` times a first-order series of unit variance.
struct Mode {
    double share, time;  // time 0: white
};

struct Case {
    const char* name;
    std::vector<Mode> modes;
    std::size_t rows;
    double least_given, most_given, least_covered;  // of all; of all; of those given
};

double phi_of(const Mode& mode) {
    return mode.time > 0.0 ? of_time(mode.time) : 0.0;
}

double exact(const std::vector<Mode>& modes) {
    double sum = 0.0;
    for (const Mode& mode : modes) sum += mode.share * mode.share * exact_integral(phi_of(mode));
    return sum;
}

/// Five columns, as an isotropic stress has.
Columns five(std::mt19937_64& generator, const std::vector<Mode>& modes, std::size_t rows) {
    Columns columns(5, std::vector<double>(rows, 0.0));
    for (auto& column : columns)
        for (const Mode& mode : modes) {
            const std::vector<double> part = autoregressive(generator, rows, phi_of(mode));
            for (std::size_t k = 0; k < rows; ++k) column[k] += mode.share * part[k];
        }
    return columns;
}

}  // namespace

TEST_CASE("the integral of white noise and of a first-order series is the known one") {
    std::mt19937_64 generator(71);
    MESSAGE("seed 71");
    for (const double time : {0.0, 1.0, 10.0}) {
        CAPTURE(time);
        const std::vector<Mode> modes = {{1.0, time}};
        const CorrelationIntegral found = correlation_integral(five(generator, modes, 40000));
        REQUIRE(found.standard_error);
        MESSAGE("time ", time, ": ", found.value, " +- ", *found.standard_error, ", known ", exact(modes), ", window ",
                found.window);
        CHECK(std::fabs(found.value - exact(modes)) < 4.0 * *found.standard_error);
        CHECK(*found.standard_error < 0.08 * exact(modes));
    }
}

// Shares of 60 are known to 0.03 where 0.95 are expected, and the ensembles are those of these seeds on each run.
TEST_CASE("error bars of integrals cover, and series that are too short get no value") {
    const Case cases[] = {{"white", {{1.0, 0.0}}, 1000, 0.9, 1.0, 0.9},
                          {"time 10, worth 250", {{1.0, 10.0}}, 5000, 0.3, 1.0, 0.85},
                          {"time 10, worth 1000", {{1.0, 10.0}}, 20000, 0.9, 1.0, 0.9},
                          {"three times", {{1.0, 2.0}, {0.5, 10.0}, {0.25, 50.0}}, 20000, 0.6, 1.0, 0.8},
                          {"slow below white", {{1.0, 0.0}, {0.1, 100.0}}, 40000, 0.4, 1.0, 0.85},
                          {"time 10, too short", {{1.0, 10.0}}, 1000, 0.0, 0.1, 0.0},
                          {"three times, too short", {{1.0, 2.0}, {0.5, 10.0}, {0.25, 50.0}}, 3000, 0.0, 0.1, 0.0},
                          {"slow below white, too short", {{1.0, 0.0}, {0.1, 100.0}}, 10000, 0.0, 0.1, 0.0}};
    unsigned seed = 500;
    for (const Case& one : cases) {
        CAPTURE(one.name);
        std::mt19937_64 generator(++seed);
        MESSAGE("seed " << seed);
        constexpr int trials = 60;
        double given = 0.0, covered = 0.0;
        for (int k = 0; k < trials; ++k) {
            const CorrelationIntegral found = correlation_integral(five(generator, one.modes, one.rows));
            if (!found.standard_error) continue;
            given += 1.0;
            covered += std::fabs(found.value - exact(one.modes)) < 2.0 * *found.standard_error;
        }
        MESSAGE("given ", given, " of ", trials, ", covered ", covered);
        CHECK(given >= one.least_given * trials);
        CHECK(given <= one.most_given * trials);
        CHECK(covered >= one.least_covered * given);
    }
}

TEST_CASE("series without a value say why") {
    const auto reason = [](const Columns& columns) {
        const CorrelationIntegral found = correlation_integral(columns);
        CHECK(std::isnan(found.value));
        CHECK(!found.standard_error);
        return found.no_value_reason;
    };
    CHECK(reason({std::vector<double>(191, 1.0)}).find("191 rows; at least 192") != std::string::npos);
    CHECK(reason({std::vector<double>(300, 0.0)}).find("constant") != std::string::npos);
    std::vector<double> broken(300, 1.0);
    broken[7] = std::nan("");
    CHECK(reason({broken}).find("not finite") != std::string::npos);
    CHECK(reason({std::vector<double>(2000, 1.0)}).find("still grows with windows of 16 of 2000 rows") !=
          std::string::npos);
    CHECK_THROWS_AS(correlation_integral(Columns{}), InputError);
    CHECK_THROWS_AS(correlation_integral(Columns{{1.0, 2.0}, {1.0}}), InputError);
}
