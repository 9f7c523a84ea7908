#include "jostle/measurement/flow_summary.hpp"

#include <array>
#include <cmath>
#include <functional>

#include "jostle/measurement/flow_columns.hpp"
#include "jostle/measurement/stress_ratio_checks.hpp"
#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/units.hpp"
#include "jostle/statistics/time_series.hpp"

namespace jostle {

namespace {

using Json = nlohmann::ordered_json;

/// Standard errors between the two sides of the identity, the largest of six elements (false alarm 4e-6 each).
constexpr double agreement = 5.0;
/// A period of fewer rows tells no sine from a cosine.
constexpr double least_rows_a_period = 8.0;

/// A column made row by row of others.
std::vector<double> rows_of(const Columns& columns, const std::function<double(const std::vector<double>&)>& value) {
    std::vector<double> rows(columns.front().size()), row(columns.size());
    for (std::size_t r = 0; r < rows.size(); ++r) {
        for (std::size_t k = 0; k < columns.size(); ++k) row[k] = columns[k][r];
        rows[r] = value(row);
    }
    return rows;
}

/// Sigma_xy of the whole stress, symmetric.
double shear_stress(const std::vector<double>& stress) {
    return 0.5 * (stress[1] + stress[3]);
}

/// Geometric and orientation stress together, six columns.
Columns turning_stress(const SeriesTable& series, std::size_t first) {
    Columns sum = window_columns(series, first, geometric_stress_column_names);
    const Columns orientation = window_columns(series, first, orientation_stress_column_names);
    for (std::size_t k = 0; k < 6; ++k)
        for (std::size_t row = 0; row < sum[k].size(); ++row) sum[k][row] += orientation[k][row];
    return sum;
}

Json steady_entry(const Scene& scene, const SeriesTable& series, std::size_t first, const Columns& stress) {
    const double rate = scene.flow.shear_rate;
    const std::string viscosity_unit = unit_of(scene, dimension::viscosity), unit = unit_of(scene, dimension::stress);
    const auto entry = [&](const std::string& in, const std::function<double(const std::vector<double>&)>& value) {
        return described(average(rows_of(stress, value)), in);
    };
    const std::vector<double>& strain = series.column("strain");
    Json flow = {{"shear_rate", {{"mean", rate}, {"unit", unit_of(scene, dimension::rate)}}},
                 {"strain", strain.back()}};
    flow["viscosity"] = entry(viscosity_unit, [&](const auto& row) { return -shear_stress(row) / rate; });
    flow["viscosity"]["definition"] = definition_of_viscosity;
    std::vector<double> by_turning = turning_stress(series, first)[1];
    for (double& value : by_turning) value /= -rate;
    flow["viscosity_of_turning"] = described(average(by_turning), viscosity_unit);
    flow["viscosity_of_turning"]["definition"] = "of geometric and orientation stress";
    flow["N1"] = entry(unit, [](const auto& row) { return row[4] - row[0]; });
    flow["N1"]["definition"] = "first normal stress difference, Sigma_yy - Sigma_xx (tension positive: as rheologists)";
    flow["N2"] = entry(unit, [](const auto& row) { return row[8] - row[4]; });
    flow["N2"]["definition"] = "second normal stress difference, Sigma_zz - Sigma_yy";
    return flow;
}

/// The parts of the shear stress in phase with the strain and with its rate, period by period.
struct Moduli {
    std::vector<double> storage, loss;
};

/// Means of sin(phase) and cos(phase) over a row.
struct PhaseMeans {
    double sine, cosine;
};

PhaseMeans phase_means(double from, double to) {
    return {(std::cos(from) - std::cos(to)) / (to - from), (std::sin(to) - std::sin(from)) / (to - from)};
}

// Rows are means over their time, so the sine and cosine that they are fitted by are, too: no row is too long. A
// constant, a sine and a cosine are fitted to the rows of each whole period by least squares.
Moduli moduli_of(const std::vector<double>& time, const std::vector<double>& tension, double row_time,
                 const ShearFlow& flow) {
    const double turn = 2.0 * std::acos(-1.0), period = turn / flow.angular_frequency;
    Moduli moduli;
    std::size_t row = 0;
    while (row < time.size()) {
        const double end = time[row] - row_time + period + 1e-9 * period;
        std::array<double, 6> a{};  // sums of 1 s, 1 c, s s, s c, c c, 1
        double with_one = 0.0, with_sine = 0.0, with_cosine = 0.0;
        std::size_t k = row;
        for (; k < time.size() && time[k] <= end; ++k) {
            const auto [s, c] =
                phase_means(flow.angular_frequency * (time[k] - row_time), flow.angular_frequency * time[k]);
            a[0] += s;
            a[1] += c;
            a[2] += s * s;
            a[3] += s * c;
            a[4] += c * c;
            a[5] += 1.0;
            with_one += tension[k];
            with_sine += s * tension[k];
            with_cosine += c * tension[k];
        }
        if (k == time.size() && time.back() < end - row_time) break;  // the last period is not whole
        const double ss = a[2] - a[0] * a[0] / a[5], sc = a[3] - a[0] * a[1] / a[5], cc = a[4] - a[1] * a[1] / a[5];
        const double fs = with_sine - a[0] * with_one / a[5], fc = with_cosine - a[1] * with_one / a[5];
        const double determinant = ss * cc - sc * sc;
        moduli.storage.push_back((fs * cc - fc * sc) / (determinant * flow.amplitude));
        moduli.loss.push_back((fc * ss - fs * sc) / (determinant * flow.amplitude));
        row = k;
    }
    return moduli;
}

Json oscillating_entry(const Scene& scene, const SeriesTable& series, std::size_t first, const Columns& stress) {
    const ShearFlow flow = flow_of(scene);
    const std::string unit = unit_of(scene, dimension::stress);
    const std::vector<double>& time = series.column("time");
    Json entry = {{"strain_amplitude", flow.amplitude},
                  {"frequency", {{"mean", scene.flow.frequency}, {"unit", unit_of(scene, dimension::rate)}}}};
    const double row_time = time.size() > 1 ? time[1] - time[0] : 0.0;
    Moduli moduli;
    if (row_time > 0.0 && scene.flow.frequency * row_time * least_rows_a_period <= 1.0)
        moduli = moduli_of(from_row(time, first), rows_of(stress, [](const auto& row) { return -shear_stress(row); }),
                           row_time, flow);
    entry["periods"] = moduli.storage.size();
    entry["storage_modulus"] = described(average(moduli.storage), unit);
    entry["loss_modulus"] = described(average(moduli.loss), unit);
    for (const char* name : {"storage_modulus", "loss_modulus"}) {
        entry[name]["definition"] = definition_of_viscosity;
        if (!moduli.storage.empty()) continue;
        entry[name]["mean"] = nullptr;
        entry[name]["no_standard_error_because"] =
            "There is no whole period of at least 8 rows: run longer, or lower output.series_every.";
    }
    return entry;
}

}  // namespace

Json flow_entry(const Scene& scene, const SeriesTable& series, std::size_t first, const Columns& stress) {
    return oscillates(scene) ? oscillating_entry(scene, series, first, stress)
                             : steady_entry(scene, series, first, stress);
}

Json torque_ratio_check(const SeriesTable& series, std::size_t first) {
    Columns columns = {turning_stress(series, first)[1], from_row(series.column(flow_stress_column_names[1]), first)};
    return check_of_one("geometric and orientation stress, element xy, over what the flow turns the axes by",
                        jackknife(columns, [](std::span<const double> means) { return means[0] / means[1]; }));
}

Json torque_identity_check(const SeriesTable& series, std::size_t first, const std::string& unit) {
    const Columns turning = turning_stress(series, first),
                  flow = window_columns(series, first, flow_stress_column_names);
    Json measured = Json::array(), expected = Json::array(), errors = Json::array();
    bool agree = true, known = true;
    for (std::size_t k = 0; k < 6; ++k) {
        std::vector<double> difference = turning[k];
        for (std::size_t row = 0; row < difference.size(); ++row) difference[row] -= flow[k][row];
        const Average apart = average(difference);
        measured.push_back(column_mean(turning[k]));
        expected.push_back(column_mean(flow[k]));
        errors.push_back(optional_number(apart.standard_error));
        known = known && apart.standard_error;
        agree = agree && apart.standard_error && std::fabs(apart.mean) <= agreement * *apart.standard_error;
    }
    return {{"definition",
             "geometric and orientation stress together, against what the flow turns the axes by: xx xy xz yy yz zz"},
            {"measured", measured},
            {"in_steady_flow", expected},
            {"standard_error", errors},
            {"unit", unit},
            {"agree", known ? Json(agree) : Json(nullptr)}};
}

}  // namespace jostle
