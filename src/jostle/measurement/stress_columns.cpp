#include "jostle/measurement/stress_columns.hpp"

#include <algorithm>

#include "jostle/stress/column_names.hpp"

namespace jostle {

namespace {

void add(std::vector<double>& sum, const std::vector<double>& part, double sign) {
    for (std::size_t row = 0; row < sum.size(); ++row) sum[row] += sign * part[row];
}

}  // namespace

Mat3 stress_of(std::span<const double> means) {
    Mat3 tensor;
    std::copy(means.begin(), means.begin() + 9, tensor.m.begin());
    return tensor;
}

Columns symmetric_columns(const SeriesTable& series, std::size_t first, const std::array<const char*, 6>& names) {
    const Columns six = window_columns(series, first, names);
    return {six[0], six[1], six[2], six[1], six[3], six[4], six[2], six[4], six[5]};
}

Columns orientation_stress_columns(const SeriesTable& series, std::size_t first) {
    return symmetric_columns(series, first, orientation_stress_column_names);
}

namespace {

/// n kT, also where the number of rods, their temperature or the box changes within a row.
std::vector<double> kinetic_column(const SeriesTable& series, std::size_t first, bool springs) {
    std::vector<double> kinetic = from_row(series.column("pressure"), first);
    add(kinetic, from_row(series.column("pressure_collision"), first), -1.0);
    if (springs) add(kinetic, from_row(series.column("pressure_springs"), first), -1.0);
    return kinetic;
}

}  // namespace

double kinetic_pressure(const SeriesTable& series, std::size_t first, bool springs) {
    return column_mean(kinetic_column(series, first, springs));
}

Columns total_stress_columns(const SeriesTable& series, std::size_t first, bool springs, bool torques, int dimensions) {
    Columns total = window_columns(series, first, stress_column_names);
    Columns parts = orientation_stress_columns(series, first);
    const std::vector<double> kinetic = kinetic_column(series, first, springs);
    if (springs) {
        const Columns of_springs = window_columns(series, first, spring_stress_column_names);
        for (std::size_t k = 0; k < 9; ++k) add(parts[k], of_springs[k], 1.0);
    }
    if (torques) {
        const Columns of_torques = window_columns(series, first, torque_stress_column_names);
        for (std::size_t k = 0; k < 9; ++k) add(parts[k], of_torques[k], 1.0);
    }
    for (std::size_t k = 0; k < 9; ++k) add(total[k], parts[k], 1.0);
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimensions); ++k) add(total[4 * k], kinetic, 1.0);
    return total;
}

}  // namespace jostle
