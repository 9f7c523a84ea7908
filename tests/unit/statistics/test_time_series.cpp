// Averages of correlated series against series whose correlation time and error are known exactly; how often error bars
// hold the mean is asked in test_error_bars_cover.cpp, too.
// A count of k successes in n trials has the standard deviation sqrt(p (1 - p)/n); limits are set at 4 of them, which
// alarms falsely once in 16,000, plus the bias that is stated beside each limit. Seeds are fixed: these tests give the
// same on each run.

#include <doctest/doctest.h>

#include <limits>

#include "autoregressive.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/statistics/student_t.hpp"
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
        // The largest of the levels errs on the safe side: bars are up to a quarter too long, so they hold more.
        CHECK(found.one_sigma > 0.683 - four_deviations(0.683, trials));
        CHECK(found.one_sigma < 0.79 + four_deviations(0.79, trials));  // a normal variable, within 1.25 deviations
        CHECK(found.two_sigma > 0.954 - four_deviations(0.954, trials));
        // The mean of 300 error bars with 20 % scatter each is known to 1.2 %.
        const double ratio = found.error / exact_standard_error(rows, phi);
        CHECK(ratio > 1.0);
        CHECK(ratio < 1.25);
        const double correlation_time = 0.5 * (1.0 + phi) / (1.0 - phi);
        CHECK(found.correlation_time > 0.9 * correlation_time);
        CHECK(found.correlation_time < 1.6 * correlation_time);
        CHECK(found.refused == 0.0);
    }
}

TEST_CASE("few samples widen the error bar as Student's t has it") {
    // t of 1, 2, 5, 8 and 30 degrees of freedom is above 12.706, 4.303, 2.571, 2.306 and 2.042 once in 40 times.
    for (const auto& [degrees, t] :
         {std::pair{2.0, 4.303}, {3.0, 3.182}, {5.0, 2.571}, {8.0, 2.306}, {30.0, 2.042}, {1e9, 1.960}})
        CHECK(widening(degrees) * 1.959964 == doctest::Approx(t).epsilon(0.01));
    CHECK(widening(0.1) == widening(1.0));
    CHECK(widening(1.0) * 1.959964 > 9.0);
}

TEST_CASE("the correlation time of columns that fluctuate together") {
    std::mt19937_64 generator(37);
    MESSAGE("seed 37");
    const double phi = std::exp(-1.0 / 50.0), exact = 0.5 * (1.0 + phi) / (1.0 - phi);
    const auto columns = [&](std::size_t rows, std::size_t count) {
        std::vector<std::vector<double>> result;
        for (std::size_t k = 0; k < count; ++k) result.push_back(autoregressive(generator, rows, phi));
        return result;
    };
    // The relative error of one is sqrt(12 exact/(rows columns)): 0.077 here, and the window leaves out 5 %.
    CHECK(correlation_time(columns(20000, 5)) == doctest::Approx(exact).epsilon(4.0 * 0.077));
    // Two correlation times of one column say nothing, but five columns together seldom pass for more than they are.
    int seems_long = 0;
    for (int k = 0; k < 200; ++k) seems_long += 200.0 / correlation_time(columns(200, 5)) >= 12.0;
    CHECK(seems_long <= 20);  // one in ten
    CHECK(correlation_time(std::vector<std::vector<double>>(2, std::vector<double>(100, 3.0))) == 0.5);
    CHECK(std::isinf(correlation_time(std::vector<std::vector<double>>{{1, 2, 3}})));
    CHECK_THROWS_AS(correlation_time(std::vector<std::vector<double>>{}), InputError);
    CHECK_THROWS_AS(correlation_time(std::vector<std::vector<double>>{{1, 2}, {1}}), InputError);
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
    CHECK(found.effective_samples > 2000.0);  // the largest error of ten levels
    REQUIRE(found.standard_error.has_value());
    CHECK(*found.standard_error ==
          doctest::Approx(found.standard_deviation / std::sqrt(found.effective_samples)).epsilon(3e-3));
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
