// Errors of functions of means, against errors known from the covariance of the means.

#include <doctest/doctest.h>

#include "autoregressive.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/math/symmetric_eigen.hpp"
#include "jostle/statistics/jackknife.hpp"
#include "jostle/statistics/time_series.hpp"

using namespace jostle;
using namespace jostle::test;

namespace {

using Columns = std::vector<std::vector<double>>;

double ratio(std::span<const double> means) {
    return means[0] / means[1];
}

}  // namespace

TEST_CASE("of the mean itself the jackknife gives the error of the mean") {
    std::mt19937_64 generator(51);
    MESSAGE("seed 51");
    const Columns columns = {autoregressive(generator, 2000, 0.7)};
    const Estimate found = jackknife(columns, [](std::span<const double> means) { return means[0]; });
    const Average direct = average(columns[0]);
    CHECK(found.value == doctest::Approx(direct.mean));
    CHECK(found.standard_error.value() == doctest::Approx(direct.standard_error.value()).epsilon(1e-9));
    CHECK(found.effective_samples == doctest::Approx(direct.effective_samples).epsilon(1e-9));
}

// x = 2 + a, y = 3 + b, a and b independent: the ratio 2/3 has the relative error e sqrt(1/4 + 1/9), e that of the mean
// of a.
TEST_CASE("ratio of two means: size and coverage of the error bar") {
    std::mt19937_64 generator(52);
    MESSAGE("seed 52");
    constexpr int trials = 300;
    constexpr std::size_t rows = 5000;
    constexpr double phi = 0.8;
    double error = 0.0, held = 0.0;
    for (int k = 0; k < trials; ++k) {
        Columns columns = {autoregressive(generator, rows, phi), autoregressive(generator, rows, phi)};
        for (double& value : columns[0]) value += 2.0;
        for (double& value : columns[1]) value += 3.0;
        const Estimate found = jackknife(columns, ratio);
        REQUIRE(found.standard_error.has_value());
        error += *found.standard_error / trials;
        held += (std::fabs(found.value - 2.0 / 3.0) < *found.standard_error) / static_cast<double>(trials);
    }
    const double exact = 2.0 / 3.0 * exact_standard_error(rows, phi) * std::sqrt(1.0 / 4.0 + 1.0 / 9.0);
    CHECK(error > exact);  // the largest of the levels: up to a quarter too long, scatter 1 %
    CHECK(error < 1.25 * exact);
    // 4 standard deviations of a count of 300 (false alarm once in 16,000).
    CHECK(held > 0.683 - 4.0 * std::sqrt(0.683 * 0.317 / trials));
}

TEST_CASE("fully correlated columns: the ratio is known without error") {
    std::mt19937_64 generator(53);
    MESSAGE("seed 53");
    Columns columns(2);
    for (const double value : autoregressive(generator, 1000, 0.5)) {
        columns[0].push_back(10.0 + value);
        columns[1].push_back(20.0 + 2.0 * value);
    }
    const Estimate found = jackknife(columns, ratio);
    CHECK(found.value == doctest::Approx(0.5).epsilon(1e-14));
    CHECK(found.standard_error.value_or(0.0) < 1e-12);
}

TEST_CASE("eigenvalue ratio of a mean tensor") {
    // Diagonal 3, 2, 1 and noise of deviation 0.1 on all six entries: to first order the ratio 3/1 has the relative
    // error 0.1/sqrt(rows) sqrt(1/9 + 1), the other entries entering in second order only.
    std::mt19937_64 generator(54);
    MESSAGE("seed 54");
    constexpr std::size_t rows = 20000;
    const double means[6] = {3.0, 2.0, 1.0, 0.0, 0.0, 0.0};
    Columns columns;
    for (const double mean : means) {
        columns.push_back(autoregressive(generator, rows, 0.0));
        for (double& value : columns.back()) value = mean + 0.1 * value;
    }
    const Estimate found = jackknife(columns, [](std::span<const double> m) {
        const auto eigen = symmetric_eigen(Mat3{{m[0], m[3], m[4], m[3], m[1], m[5], m[4], m[5], m[2]}});
        return eigen.values[2] / eigen.values[0];
    });
    const double exact = 3.0 * 0.1 * std::sqrt((1.0 / 9.0 + 1.0) / rows);
    CHECK(std::fabs(found.value - 3.0) < 4.0 * exact);  // false alarm once in 16,000
    // One error bar scatters by about 5 %, and may be chosen from a coarser level.
    CHECK(found.standard_error.value() > 0.8 * exact);
    CHECK(found.standard_error.value() < 1.6 * exact);
}

TEST_CASE("refusals") {
    const Columns short_columns = {{1, 2, 3}, {4, 5, 6}};
    CHECK(!jackknife(short_columns, ratio).standard_error.has_value());
    CHECK(!jackknife(short_columns, ratio).no_error_reason.empty());
    CHECK(jackknife(short_columns, ratio).value == doctest::Approx(0.4));
    std::mt19937_64 generator(55);
    const Columns no_ratio = {autoregressive(generator, 100, 0.0), std::vector<double>(100, 0.0)};
    CHECK(jackknife(no_ratio, ratio).no_error_reason.find("not finite") != std::string::npos);
    CHECK(jackknife(Columns{{}, {}}, ratio).no_error_reason.find("not finite") != std::string::npos);
    CHECK_THROWS_AS(jackknife(Columns{}, ratio), InputError);
    CHECK_THROWS_AS(jackknife(Columns{{1, 2}, {1}}, ratio), InputError);
}
