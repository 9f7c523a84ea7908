// Averages of correlated series against series whose correlation time and error are known exactly.
// A count of k successes in n trials has the standard deviation sqrt(p (1 - p)/n); limits are set at 4 of them, which
// alarms falsely once in 16,000, plus the bias that is stated beside each limit. Seeds are fixed: these tests give the
// same on each run.

#include <doctest/doctest.h>

#include <limits>

#include "autoregressive.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/statistics/time_series.hpp"

using namespace jostle;
using namespace jostle::test;

namespace {

struct Coverage {
    double one_sigma = 0.0, two_sigma = 0.0;  // share of error bars that hold the true mean, 0
    double error = 0.0;                       // mean error bar
    double correlation_time = 0.0;            // mean
    double refused = 0.0;                     // share of series without an error bar
};

template <class Series>
Coverage coverage(int trials, Series&& series) {
    Coverage result;
    double accepted = 0.0;
    for (int k = 0; k < trials; ++k) {
        const Average found = average(series());
        if (!found.standard_error) continue;
        accepted += 1.0;
        result.one_sigma += std::fabs(found.mean) < *found.standard_error;
        result.two_sigma += std::fabs(found.mean) < 2.0 * *found.standard_error;
        result.error += *found.standard_error;
        result.correlation_time += found.correlation_time;
    }
    for (double* sum : {&result.one_sigma, &result.two_sigma, &result.error, &result.correlation_time})
        *sum /= accepted;
    result.refused = 1.0 - accepted / trials;
    return result;
}

double four_deviations(double share, int trials) {
    return 4.0 * std::sqrt(share * (1.0 - share) / trials);
}

}  // namespace

TEST_CASE("error bars hold the true mean as often as they should") {
    constexpr int trials = 300;
    std::mt19937_64 generator(31);
    MESSAGE("seed 31");
    struct Row {
        std::size_t rows;
        double phi;
    };
    for (const Row& row : {Row{2000, 0.0}, Row{4000, 0.9}, Row{3000, 0.5}, Row{10000, 0.96}}) {
        const std::size_t rows = row.rows;
        const double phi = row.phi;
        const Coverage found = coverage(trials, [&] { return autoregressive(generator, rows, phi); });
        CAPTURE(rows);
        CAPTURE(phi);
        // Bias allowed: 0.02, from the scatter of the error bar itself at 200 effective samples and more.
        CHECK(std::fabs(found.one_sigma - 0.683) < four_deviations(0.683, trials) + 0.02);
        CHECK(std::fabs(found.two_sigma - 0.954) < four_deviations(0.954, trials) + 0.02);
        // The mean of 300 error bars with 20 % scatter each is known to 1.2 %; the bias to larger values is below 6 %.
        const double ratio = found.error / exact_standard_error(rows, phi);
        CHECK(ratio > 0.96);
        CHECK(ratio < 1.10);
        const double correlation_time = 0.5 * (1.0 + phi) / (1.0 - phi);
        CHECK(found.correlation_time > 0.9 * correlation_time);
        CHECK(found.correlation_time < 1.2 * correlation_time);
        CHECK(found.refused == 0.0);
    }
}

TEST_CASE("a short correlated series: error bars near the limit of ten samples, and refusals below it") {
    std::mt19937_64 generator(32);
    MESSAGE("seed 32");
    constexpr int trials = 500;
    // 25 effective samples: the bar scatters by half its size, so it holds the mean 4 % less often than a sure one.
    const Coverage few = coverage(trials, [&] { return autoregressive(generator, 475, 0.9); });
    CHECK(few.one_sigma > 0.683 - 0.07 - four_deviations(0.683, trials));
    CHECK(few.one_sigma < 0.683 + four_deviations(0.683, trials));
    CHECK(few.refused < 0.15);
    // 3 effective samples: refused three times out of four; else the series looks fast by chance, as short ones may.
    const Coverage too_few = coverage(trials, [&] { return autoregressive(generator, 60, 0.9); });
    CHECK(too_few.refused > 0.75 - four_deviations(0.75, trials));
}

TEST_CASE("a slow mode below fast noise is seen") {
    // White noise of variance 1 and a mode of variance 0.09 with correlation time 50: g = (1 + 0.09 * 100)/1.09 = 9.2.
    std::mt19937_64 generator(33);
    MESSAGE("seed 33");
    constexpr int trials = 100;
    constexpr std::size_t rows = 20000;
    const double phi = std::exp(-1.0 / 50.0);
    const Coverage found = coverage(trials, [&] {
        std::vector<double> series = autoregressive(generator, rows, 0.0);
        const std::vector<double> slow = autoregressive(generator, rows, phi);
        for (std::size_t k = 0; k < rows; ++k) series[k] += 0.3 * slow[k];
        return series;
    });
    const double slow_error = 0.3 * exact_standard_error(rows, phi);
    const double exact = std::sqrt(1.0 / rows + slow_error * slow_error);
    // The window alone gives 0.45 here, and holds the mean in 36 % of the cases.
    CHECK(found.error > 0.85 * exact);
    CHECK(found.error < 1.10 * exact);
    CHECK(found.one_sigma > 0.683 - 0.03 - four_deviations(0.683, trials));
}

TEST_CASE("independent rows: every row counts, and the standard deviation is that of the rows") {
    std::mt19937_64 generator(34);
    MESSAGE("seed 34");
    std::vector<double> series = autoregressive(generator, 10000, 0.0);
    for (double& value : series) value = 5.0 + 2.0 * value;
    const Average found = average(series);
    CHECK(found.mean == doctest::Approx(5.0).epsilon(0.02));                // 5 standard errors
    CHECK(found.standard_deviation == doctest::Approx(2.0).epsilon(0.03));  // 4 standard deviations
    CHECK(found.effective_samples <= 10000.0);
    CHECK(found.effective_samples > 5000.0);
    REQUIRE(found.standard_error.has_value());
    CHECK(*found.standard_error ==
          doctest::Approx(found.standard_deviation / std::sqrt(found.effective_samples)).epsilon(1e-3));
    CHECK(found.no_error_reason.empty());
}

TEST_CASE("an anticorrelated series claims no more than its rows") {
    std::mt19937_64 generator(35);
    MESSAGE("seed 35");
    const Average found = average(autoregressive(generator, 1000, -0.8));
    CHECK(found.effective_samples == 1000.0);
    CHECK(found.correlation_time == 0.5);
}

TEST_CASE("no error bar without a ground for one, and the reason says why") {
    const auto refused = [](const std::vector<double>& series, const char* word) {
        const Average found = average(series);
        CHECK(!found.standard_error.has_value());
        CAPTURE(found.no_error_reason);
        CHECK(found.no_error_reason.find(word) != std::string::npos);
        CHECK(found.no_error_reason.back() == '.');
    };
    refused({}, "no rows");
    refused({1.0}, "only 1 rows");
    refused({1, 2, 3, 4, 5, 6, 7, 8, 9}, "9 rows");
    refused(std::vector<double>(1000, 0.1), "constant");
    refused(std::vector<double>(1000, 0.0), "constant");
    std::vector<double> broken(1000, 0.1);
    broken[500] = std::numeric_limits<double>::quiet_NaN();
    refused(broken, "finite");
    std::vector<double> ramp(1000);
    for (std::size_t k = 0; k < ramp.size(); ++k) ramp[k] = static_cast<double>(k);
    refused(ramp, "independent");
    CHECK(average(ramp).mean == doctest::Approx(499.5));
    CHECK(std::isnan(average(std::vector<double>{}).mean));
}

TEST_CASE("units and origin do not matter") {
    std::mt19937_64 generator(36);
    MESSAGE("seed 36");
    const std::vector<double> series = autoregressive(generator, 5000, 0.8);
    std::vector<double> other = series;
    for (double& value : other) value = 7.0 + 1e-6 * value;
    const Average a = average(series), b = average(other);
    CHECK(b.effective_samples == doctest::Approx(a.effective_samples).epsilon(1e-6));
    CHECK(b.standard_error.value() == doctest::Approx(1e-6 * a.standard_error.value()).epsilon(1e-6));
    CHECK(b.mean == doctest::Approx(7.0 + 1e-6 * a.mean).epsilon(1e-14));
}

TEST_CASE("block means leave out the first rows of an uneven number") {
    const std::vector<double> series = {100, 1, 2, 3, 4, 5, 6};
    CHECK(block_means(series, 2) == std::vector<double>{1.5, 3.5, 5.5});
    CHECK(block_means(series, 7).size() == 1);
    CHECK(block_means(series, 8).empty());
    CHECK_THROWS_AS(block_means(series, 0), InputError);
}
