// What an error bar promises, on ensembles of series whose mean, 0, is known: where one is given, twice it holds the
// mean in 90 of 100 cases or more, and the means scatter by no more than 1.2 times it; of series too short for it at
// most one in ten gets one. Seeds are fixed: these tests give the same on each run. The shares are known to sqrt(p (1 -
// p)/trials): 1.1 % for 0.95 of 400, 1.4 % for 0.08.

#include <doctest/doctest.h>

#include <functional>

#include "autoregressive.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/statistics/time_series.hpp"

using namespace jostle;
using namespace jostle::test;

namespace {

constexpr int trials = 400;

using Series = std::function<std::vector<double>(std::mt19937_64&)>;
using Averaged = std::function<Average(std::mt19937_64&)>;

struct Ensemble {
    double given = 0.0;    // share of series with an error bar
    double covered = 0.0;  // share of error bars that, twice, hold the mean
    double ratio = 0.0;    // root mean square of the means over the mean error bar
};

Ensemble ensemble_of(const Averaged& averaged, unsigned seed) {
    std::mt19937_64 generator(seed);
    MESSAGE("seed " << seed);
    Ensemble result;
    double squares = 0.0, errors = 0.0;
    for (int k = 0; k < trials; ++k) {
        const Average found = averaged(generator);
        if (!found.standard_error) continue;
        result.given += 1.0;
        result.covered += std::fabs(found.mean) < 2.0 * *found.standard_error;
        squares += found.mean * found.mean;
        errors += *found.standard_error;
    }
    result.covered /= result.given;
    result.ratio = std::sqrt(squares / result.given) / (errors / result.given);
    result.given /= trials;
    return result;
}

Ensemble ensemble(const Series& series, unsigned seed) {
    return ensemble_of([&](std::mt19937_64& generator) { return average(series(generator)); }, seed);
}

Series first_order(std::size_t rows, double time) {
    return [=](std::mt19937_64& generator) { return autoregressive(generator, rows, std::exp(-1.0 / time)); };
}

}  // namespace

TEST_CASE("error bars that are given cover") {
    struct Case {
        const char* name;
        Series series;
        double least_given;
    };
    const auto slow_below = [](std::size_t rows, double fast, double share, double time) -> Series {
        return [=](std::mt19937_64& generator) {
            return with_slow_mode(generator, autoregressive(generator, rows, fast), share, time);
        };
    };
    const Case cases[] = {
        {"white, 64 rows", first_order(64, 1e-3), 0.9},
        {"white, 2000 rows", first_order(2000, 1e-3), 1.0},
        {"first order, time 10, worth 25", first_order(500, 10.0), 0.3},
        {"first order, time 10, worth 100", first_order(2000, 10.0), 0.97},
        {"first order, time 3, worth 100", first_order(600, 3.0), 0.95},
        {"first order, time 50, worth 40", first_order(4000, 50.0), 0.7},
        {"second order, overdamped", [](auto& g) { return autoregressive_2(g, 1000, 1.4, -0.45); }, 0.8},
        {"second order, ringing", [](auto& g) { return autoregressive_2(g, 400, 1.6, -0.8); }, 0.95},
        {"white and 0.3 of time 50, worth 115", slow_below(1000, 0.0, 0.3, 50.0), 0.95},
        {"white and 0.3 of time 50, worth 350", slow_below(3000, 0.0, 0.3, 50.0), 0.99},
        {"time 1 and 0.2 of time 200, worth 400", slow_below(6000, std::exp(-1.0), 0.2, 200.0), 0.99},
    };
    unsigned seed = 300;
    for (const Case& one : cases) {
        CAPTURE(one.name);
        const Ensemble found = ensemble(one.series, ++seed);
        CHECK(found.given >= one.least_given);
        CHECK(found.covered >= 0.90);
        CHECK(found.ratio <= 1.2);
        CHECK(found.ratio >= 0.65);  // nor are they far too large
    }
}

TEST_CASE("of series worth fewer than ten samples at most one in ten gets an error bar") {
    unsigned seed = 400;
    struct Case {
        std::size_t rows;
        double time;
    };
    for (const Case& one : {Case{64, 10.0}, Case{100, 10.0}, Case{190, 10.0}, Case{200, 50.0}, Case{400, 50.0},
                            Case{900, 50.0}, Case{50, 3.0}, Case{1000, 200.0}, Case{3600, 200.0}}) {
        CAPTURE(one.rows);
        CAPTURE(one.time);
        CHECK(ensemble(first_order(one.rows, one.time), ++seed).given <= 0.10);
    }
    // of second order, worth 9
    CHECK(ensemble([](auto& g) { return autoregressive_2(g, 190, 1.4, -0.45); }, ++seed).given <= 0.10);
    // a straight drift by eight times the noise, and a relaxation that is as slow as the series is long
    const auto drifting = [](std::mt19937_64& generator) {
        std::vector<double> series = autoregressive(generator, 400, 0.0);
        for (std::size_t k = 0; k < series.size(); ++k) series[k] += 8.0 * (static_cast<double>(k) / 400.0 - 0.5);
        return series;
    };
    const auto relaxing = [](std::mt19937_64& generator) {
        std::vector<double> series = autoregressive(generator, 400, 0.0);
        for (std::size_t k = 0; k < series.size(); ++k) series[k] += 8.0 * std::exp(-static_cast<double>(k) / 400.0);
        return series;
    };
    CHECK(ensemble(drifting, ++seed).given <= 0.10);
    CHECK(ensemble(relaxing, ++seed).given <= 0.10);
}

TEST_CASE("a slow part that another column shows is in the error bar, and none where there is none") {
    constexpr std::size_t rows = 1500;
    constexpr double time = 100.0;
    const auto averaged = [&](double share, bool beside, bool known) -> Averaged {
        return [=](std::mt19937_64& generator) {
            const SlowColumn slow{autoregressive(generator, rows, std::exp(-1.0 / time)), time, known};
            std::vector<double> series = autoregressive(generator, rows, 0.0);
            for (std::size_t k = 0; k < rows; ++k) series[k] += share * slow.rows[k];
            return beside ? average(series, slow) : average(series);
        };
    };
    unsigned seed = 500;
    for (const double share : {0.0, 0.1, 0.2, 0.5}) {
        CAPTURE(share);
        const Ensemble found = ensemble_of(averaged(share, true, true), ++seed);
        const Ensemble alone = ensemble_of(averaged(share, false, true), seed);  // of the same series
        CHECK(found.covered >= 0.93);
        CHECK(found.ratio <= 1.1);
        CHECK(found.ratio >= 0.65);
        CHECK(found.covered >= alone.covered + (share > 0.0 ? 0.02 : 0.0));
        CHECK(ensemble_of(averaged(share, true, false), seed).covered >= found.covered);
    }
}

TEST_CASE("a series that is nothing but the slow column has its error bar") {
    const auto averaged = [](std::mt19937_64& generator) {
        const SlowColumn slow{autoregressive(generator, 8000, std::exp(-1.0 / 50.0)), 50.0, true};
        std::vector<double> series = slow.rows;
        for (double& value : series) value *= -3.0;
        return average(series, slow);
    };
    const Ensemble found = ensemble_of(averaged, 600);
    CHECK(found.given >= 0.9);
    CHECK(found.covered >= 0.93);
    CHECK(found.ratio <= 1.1);
}

TEST_CASE("a slow column that is constant, or shorter than its own correlation time") {
    std::mt19937_64 generator(700);
    const std::vector<double> series = autoregressive(generator, 400, 0.0);
    const Average alone = average(series);
    CHECK(average(series, SlowColumn{std::vector<double>(400, 0.25), 10.0}).standard_error == alone.standard_error);
    const std::vector<double> other = autoregressive(generator, 400, 0.0);
    CHECK(!average(series, SlowColumn{other, 200.0}).standard_error);
    CHECK(average(series, SlowColumn{other, 200.0}).no_error_reason.size() > 20);
    CHECK_THROWS_AS(average(series, SlowColumn{std::vector<double>(399, 0.0), 10.0}), InputError);
}
