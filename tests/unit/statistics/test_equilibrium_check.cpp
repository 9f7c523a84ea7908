// When a window of production is called equilibrium: clocks first, drifts then. Seeds are fixed: these tests give the
// same on each run.

#include <doctest/doctest.h>

#include "autoregressive.hpp"
#include "jostle/statistics/equilibrium_check.hpp"
#include "jostle/statistics/time_series.hpp"

using namespace jostle;
using namespace jostle::test;

namespace {

using Verdict = EquilibriumCheck::Verdict;

/// An isotropic state whose order tensor decays in `decay` rows and whose pressure is noise of correlation time 1.
ProductionSeries isotropic(std::mt19937_64& generator, std::size_t rows, double decay) {
    ProductionSeries series;
    series.row_time = 1.0;
    series.watched = {{"collision pressure", autoregressive(generator, rows, std::exp(-1.0))}};
    for (int k = 0; k < 6; ++k) series.order_tensor.push_back(autoregressive(generator, rows, std::exp(-1.0 / decay)));
    for (std::size_t row = 0; row < rows; ++row) {  // traceless, and of the size of a few hundred rods
        const double third =
            (series.order_tensor[0][row] + series.order_tensor[3][row] + series.order_tensor[5][row]) / 3.0;
        for (const std::size_t diagonal : {0, 3, 5}) series.order_tensor[diagonal][row] -= third;
        double square = 0.0;
        for (auto& element : series.order_tensor) {
            element[row] *= 0.02;
            square += element[row] * element[row];
        }
        series.order.push_back(std::sqrt(square));
    }
    return series;
}

/// Of a time of 100: spheres, whose axes do not matter, and whose pressure is white noise.
ProductionSeries noise_of_spheres(std::mt19937_64& generator) {
    ProductionSeries series;
    series.row_time = 0.1;
    series.watched = {{"collision pressure", autoregressive(generator, 1000, 0.0)}};
    return series;
}

}  // namespace

TEST_CASE("a window shorter than four rotation times of a free rod is too short, whatever the series show") {
    std::mt19937_64 generator(81);
    MESSAGE("seed 81");
    const EquilibriumCheck found = check_equilibrium(isotropic(generator, 2000, 2.0), {15000.0, 10.0});
    CHECK(found.verdict == Verdict::too_short);
    CHECK(found.rotation_times == doctest::Approx(2000.0 / 15000.0));
    CHECK(found.rotation_time == 15000.0);
    CHECK(found.diffusion_times == 200.0);
    CHECK(in_words(found) == "too short to tell: covers 0.13 of a rotation time; at least 4 are needed");
}

TEST_CASE("a long window of a steady state is equilibrium") {
    std::mt19937_64 generator(82);
    MESSAGE("seed 82");
    int reached = 0;
    for (int k = 0; k < 100; ++k)
        reached += check_equilibrium(isotropic(generator, 6000, 60.0), {180.0, 50.0}).verdict == Verdict::reached;
    // 100 correlation times. Two columns alarm falsely once in 70 times each: 3 of 100 expected, 11 once in 10,000.
    CHECK(reached > 89);
    const EquilibriumCheck found = check_equilibrium(isotropic(generator, 6000, 60.0), {180.0, 50.0});
    CHECK(found.diffusion_times == doctest::Approx(120.0));
    CHECK(found.rotation_times > 20.0);  // 33, were the decay known exactly
    CHECK(found.rotation_times <= 33.4);
}

TEST_CASE("a crowd that turns more slowly than the window is long is too short to tell") {
    std::mt19937_64 generator(83);
    MESSAGE("seed 83");
    // A rod alone would have turned a hundred times; the order tensor of the crowd has four correlation times.
    int too_short = 0;
    for (int k = 0; k < 100; ++k)
        too_short += check_equilibrium(isotropic(generator, 2000, 500.0), {20.0, 20.0}).verdict == Verdict::too_short;
    CHECK(too_short >= 90);
}

TEST_CASE("white noise with a slow mode, worth fewer than ten samples: the order shows what the series hides") {
    // The pressure follows Q:Q, which decays twice as fast as Q. Alone it would have an error bar in one to seven of
    // ten cases.
    struct Case {
        double share, time;  // of the mode, in standard deviations of the noise
        std::size_t rows;
    };
    std::mt19937_64 generator(88);
    MESSAGE("seed 88");
    for (const Case& one : {Case{0.5, 300.0, 500}, Case{0.5, 100.0, 200}, Case{1.0, 30.0, 200}}) {
        CAPTURE(one.time);
        int alone = 0, judged = 0;
        for (int k = 0; k < 200; ++k) {
            ProductionSeries series = isotropic(generator, one.rows, 2.0 * one.time);
            std::vector<double>& pressure = series.watched[0].rows;
            pressure = autoregressive(generator, one.rows, 0.0);
            for (std::size_t row = 0; row < one.rows; ++row) {
                // S here is the root of six squares of 0.02^2, two thirds of three of them: mean 5, variance 10 of Q:Q
                const double square = series.order[row] * series.order[row] / 4e-4;
                pressure[row] += one.share * (square - 5.0) / std::sqrt(10.0);
            }
            const bool has_bar = average(pressure).standard_error.has_value();
            alone += has_bar;
            judged += has_bar && check_equilibrium(series, {10.0, 10.0}).verdict == Verdict::reached;
        }
        CHECK(alone > 20);
        CHECK(judged <= 20);
    }
}

TEST_CASE("a drifting column is named") {
    std::mt19937_64 generator(84);
    MESSAGE("seed 84");
    ProductionSeries series = isotropic(generator, 4000, 20.0);
    for (std::size_t row = 0; row < 4000; ++row) series.watched[0].rows[row] += 1e-3 * static_cast<double>(row);
    const EquilibriumCheck found = check_equilibrium(series, {60.0, 50.0});
    CHECK(found.verdict == Verdict::drifting);
    CHECK(in_words(found).find("not reached: the collision pressure changes by") == 0);
}

TEST_CASE("spheres are asked for diffusion and drifts only, a nematic not for its director") {
    std::mt19937_64 generator(85);
    MESSAGE("seed 85");
    const ProductionSeries spheres = noise_of_spheres(generator);
    CHECK(check_equilibrium(spheres, {0.0, 9.4}).verdict == Verdict::reached);
    CHECK(in_words(check_equilibrium(spheres, {0.0, 60.0})) ==
          "too short to tell: covers 1.67 diffusion times; at least 2 are needed");
    ProductionSeries nematic = isotropic(generator, 2000, 5.0);
    for (std::size_t row = 0; row < 2000; ++row) {  // the director turns from z to x, once in the window
        const double angle = 1.5 * static_cast<double>(row) / 2000.0, S = 0.8;
        nematic.order[row] += S;
        nematic.order_tensor[0][row] += S * (1.5 * std::sin(angle) * std::sin(angle) - 0.5);
        nematic.order_tensor[2][row] += S * 1.5 * std::sin(angle) * std::cos(angle);
        nematic.order_tensor[3][row] -= 0.5 * S;
        nematic.order_tensor[5][row] += S * (1.5 * std::cos(angle) * std::cos(angle) - 0.5);
    }
    CHECK(check_equilibrium(nematic, {100.0, 50.0}).verdict == Verdict::reached);
    FreeClocks slow = {100.0, 50.0};
    slow.slowdown = 8.0;
    CHECK(in_words(check_equilibrium(nematic, slow)) ==
          "too short to tell: covers 2.5 rotation times; at least 4 are needed, slow as the crowd is");
    CHECK(check_equilibrium(isotropic(generator, 6000, 60.0), {180.0, 50.0, 0.0, 100.0}).verdict == Verdict::reached);
}

TEST_CASE("walls, a bath, springs, and rods that pass each other are asked for two of their times") {
    std::mt19937_64 generator(86);
    MESSAGE("seed 86");
    const ProductionSeries spheres = noise_of_spheres(generator);
    FreeClocks clocks = {0.0, 9.4};
    clocks.spreading = 400.0;
    CHECK(in_words(check_equilibrium(spheres, clocks)) ==
          "too short to tell: covers 0.25 of a spreading time; at least 2 are needed");
    clocks.spreading = 25.0;
    clocks.volume = 80.0;
    CHECK(in_words(check_equilibrium(spheres, clocks)) ==
          "too short to tell: covers 1.25 relaxation times; at least 2 are needed");
    clocks.volume = 20.0;
    CHECK(in_words(check_equilibrium(spheres, clocks)) ==
          "reached: covers 10.6 diffusion times, 4 spreading times, 5 relaxation times");
    clocks.springs = 60.0;
    CHECK(in_words(check_equilibrium(spheres, clocks)) ==
          "too short to tell: covers 1.67 spring relaxation times; at least 2 are needed");
    clocks.springs = 50.0;
    clocks.passing = 80.0;
    CHECK(in_words(check_equilibrium(spheres, clocks)) ==
          "too short to tell: covers 1.25 passing times; at least 2 are needed");
    clocks.passing = 40.0;
    CHECK(in_words(check_equilibrium(spheres, clocks)) ==
          "reached: covers 10.6 diffusion times, 2.5 passing times, 4 spreading times, 5 relaxation times, 2 spring "
          "relaxation times");
    CHECK(shortest_window(clocks) == 100.0);
    clocks.rotation = 30.0;
    CHECK(shortest_window(clocks) == 120.0);
}

TEST_CASE("rods that nothing turns but their neighbours are judged by how their order decays") {
    std::mt19937_64 generator(87);
    MESSAGE("seed 87");
    int too_short = 0, reached = 0;
    for (int k = 0; k < 100; ++k) {
        too_short += check_equilibrium(isotropic(generator, 2000, 500.0), {}).verdict == Verdict::too_short;
        reached += check_equilibrium(isotropic(generator, 6000, 60.0), {}).verdict == Verdict::reached;
    }
    CHECK(too_short >= 90);
    CHECK(reached > 89);
}

TEST_CASE("nothing to judge") {
    CHECK(check_equilibrium({}, {}).verdict == Verdict::reached);  // no clock, and nothing that drifts
    CHECK(in_words(EquilibriumCheck{}) == "not checked");
    CHECK(check_equilibrium({}, {10.0, 10.0}).verdict == Verdict::too_short);
}
