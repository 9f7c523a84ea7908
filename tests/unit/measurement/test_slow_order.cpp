// Which column of the order others follow slowly, and how slowly.

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "jostle/measurement/slow_order.hpp"
#include "jostle/stress/column_names.hpp"

using namespace jostle;

namespace {

constexpr std::size_t rows = 4000;
constexpr double row_time = 0.5;

/// S about `order`, and an order tensor with xx = 0.1 and xy = 0.2, both with noise that rows forget at once.
SeriesTable series_of_order(double order) {
    std::mt19937_64 engine(1);
    std::normal_distribution<double> noise(0.0, 0.01);
    SeriesTable series;
    series.names = {"nematic_order"};
    for (const char* name : order_tensor_column_names) series.names.push_back(name);
    series.columns.resize(series.names.size());
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t k = 0; k < series.columns.size(); ++k)
            series.columns[k].push_back((k == 0 ? order : k < 3 ? 0.1 * static_cast<double>(k) : 0.0) + noise(engine));
    return series;
}

ProductionWindow window_with(double rotation_time) {
    ProductionWindow window;
    window.first_row = 100;
    window.equilibrium.rotation_time = rotation_time;
    return window;
}

}  // namespace

TEST_CASE("S of a nematic, with the correlation time of the clock") {
    const SeriesTable series = series_of_order(0.7);
    const auto slow = slow_order(window_with(60.0), series, row_time, 3);
    REQUIRE(slow);
    CHECK(slow->rows.size() == rows - 100);
    CHECK(slow->rows.front() == series.column("nematic_order")[100]);
    CHECK(slow->correlation_time == doctest::Approx(60.0 / 3.0 / row_time));
    CHECK(slow->time_is_known);
    CHECK(slow_order(window_with(60.0), series, row_time, 2)->correlation_time ==
          doctest::Approx(60.0 / 4.0 / row_time));
}

TEST_CASE("else Q:Q, which decays twice as fast") {
    const auto slow = slow_order(window_with(60.0), series_of_order(0.1), row_time, 3);
    REQUIRE(slow);
    double mean = 0.0;
    for (const double value : slow->rows) mean += value / static_cast<double>(slow->rows.size());
    CHECK(mean == doctest::Approx(0.1 * 0.1 + 2.0 * 0.2 * 0.2).epsilon(0.02));
    CHECK(slow->correlation_time == doctest::Approx(60.0 / 6.0 / row_time));
    CHECK(!slow->time_is_known);
}

TEST_CASE("rows that show a longer time than the clock count, and then it is not known beforehand") {
    SeriesTable series = series_of_order(0.7);
    double slow_part = 0.0;
    std::mt19937_64 engine(2);
    std::normal_distribution<double> noise;
    for (double& order : series.columns[0]) {
        slow_part = 0.95 * slow_part + 0.01 * noise(engine);
        order += slow_part;
    }
    const auto slow = slow_order(window_with(3.0), series, row_time, 3);
    REQUIRE(slow);
    CHECK(slow->correlation_time > 5.0);  // the clock has 2 rows
    CHECK(!slow->time_is_known);
}

TEST_CASE("none where nothing turns, or nobody knows how slowly") {
    const SeriesTable series = series_of_order(0.7);
    CHECK(!slow_order(window_with(0.0), series, row_time, 3));
    CHECK(!slow_order(window_with(INFINITY), series, row_time, 3));
}
