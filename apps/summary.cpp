#include "summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "jostle/io/series_columns.hpp"
#include "jostle/io/units.hpp"
#include "jostle/math/symmetric_eigen.hpp"
#include "jostle/simulation/rod_size.hpp"
#include "jostle/statistics/equilibration.hpp"
#include "jostle/statistics/jackknife.hpp"
#include "jostle/statistics/time_series.hpp"
#include "jostle/stress/spherocylinder_moments.hpp"
#include "jostle/stress/stress.hpp"

using namespace jostle;
using Json = nlohmann::ordered_json;

namespace {

/// Standard errors between measured and predicted anisotropy that are still called agreement (false alarm 6e-5).
constexpr double agreement = 4.0;
/// Order above which a run is a nematic. Isotropic phases of rods end below.
constexpr double nematic_above = 0.4;

using Columns = std::vector<std::vector<double>>;

std::vector<double> from_row(const std::vector<double>& column, std::size_t first) {
    return {column.begin() + static_cast<std::ptrdiff_t>(std::min(first, column.size())), column.end()};
}

Columns window_columns(const SeriesTable& series, std::size_t first, std::span<const char* const> names) {
    Columns columns;
    for (const char* name : names) columns.push_back(from_row(series.column(name), first));
    return columns;
}

Json optional_number(const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json described(const Average& average, const std::string& unit) {
    Json entry = {{"mean", average.mean},
                  {"standard_error", optional_number(average.standard_error)},
                  {"n_eff", average.effective_samples},
                  {"standard_deviation", average.standard_deviation},
                  {"correlation_time_rows", average.correlation_time}};
    if (!average.no_error_reason.empty()) entry["no_standard_error_because"] = average.no_error_reason;
    if (!unit.empty()) entry["unit"] = unit;
    return entry;
}

Json described(const Estimate& estimate) {
    Json entry = {{"mean", std::isfinite(estimate.value) ? Json(estimate.value) : Json(nullptr)},
                  {"standard_error", optional_number(estimate.standard_error)},
                  {"n_eff", estimate.effective_samples}};
    if (!estimate.no_error_reason.empty()) entry["no_standard_error_because"] = estimate.no_error_reason;
    return entry;
}

Json tensor_entry(const Columns& columns, const std::string& unit) {
    Json mean = Json::array(), error = Json::array();
    for (std::size_t a = 0; a < 3; ++a) {
        Json mean_row = Json::array(), error_row = Json::array();
        for (std::size_t b = 0; b < 3; ++b) {
            const Average element = average(columns[3 * a + b]);
            mean_row.push_back(element.mean);
            error_row.push_back(optional_number(element.standard_error));
        }
        mean.push_back(mean_row);
        error.push_back(error_row);
    }
    return {{"mean", mean}, {"standard_error", error}, {"unit", unit}};
}

Mat3 stress_of(std::span<const double> means) {
    Mat3 tensor;
    std::copy(means.begin(), means.begin() + 9, tensor.m.begin());
    return tensor;
}

Mat3 order_of(std::span<const double> means) {
    const auto q = means.first(6);
    return Mat3{{q[0], q[1], q[2], q[1], q[3], q[4], q[2], q[4], q[5]}};
}

double along(const Mat3& tensor, const Vec3& direction) {
    return dot(direction, tensor * direction);
}

double mean_of(const std::vector<double>& column) {
    return average(column).mean;
}

struct MeanDirector {
    Vec3 direction;  ///< which end of it is the head is arbitrary
    double order;    ///< S of the mean order tensor
};

/// Largest eigenvalue of the mean order tensor, and its eigenvector.
MeanDirector mean_director(const Columns& order) {
    std::array<double, 6> mean{};
    for (std::size_t k = 0; k < 6; ++k) mean[k] = mean_of(order[k]);
    const auto eigen = symmetric_eigen(order_of(mean));
    return {eigen.vectors[2], eigen.values[2]};
}

double eigenvalue_ratio(std::span<const double> stress) {
    return anisotropy_ratio(stress_of(stress));
}

/// The active stress, over the rows of the window that have one.
void summarise_active_stress(const SeriesTable& series, std::size_t first, const std::string& unit, Json& summary) {
    const std::vector<double>& pressure = series.column("pressure_active");
    while (first < pressure.size() && !std::isfinite(pressure[first])) ++first;
    summary["pressure_active"] = described(average(from_row(pressure, first)), unit);
    if (first >= pressure.size()) {
        summary["pressure_active"]["mean"] = nullptr;
        summary["pressure_active"]["no_standard_error_because"] =
            "The run is shorter than output.active_stress_lag: displacements are not old enough.";
        return;
    }
    summary["stress_active"] = tensor_entry(window_columns(series, first, active_stress_column_names), unit);
}

/// Eigenvalues of the mean collision stress, ascending.
Json mean_principal_stresses(const Columns& stress) {
    std::array<double, 9> mean{};
    for (std::size_t k = 0; k < 9; ++k) mean[k] = mean_of(stress[k]);
    return principal_stresses(stress_of(mean));
}

void set_null(Json& entry) {
    if (!entry.is_array()) entry = nullptr;
    for (Json& element : entry) set_null(element);
}

/// Takes away all error bars: the means are of no state that lasts.
void withhold_errors(Json& entry, const std::string& reason) {
    if (!entry.is_object()) return;
    if (entry.contains("standard_error")) {
        set_null(entry["standard_error"]);
        entry["no_standard_error_because"] = reason;
    }
    for (Json& part : entry) withhold_errors(part, reason);
}

bool all_alike(const Rods& rods) {
    const auto same = [](const std::vector<double>& values) {
        return std::all_of(values.begin(), values.end(), [&](double value) { return value == values.front(); });
    };
    return same(rods.length) && same(rods.diameter);
}

/// The collision stress along the mean director over that across it, measured, and as in equilibrium it follows from Z
/// and the order tensor alone (theory, eq. 1.8).
Json anisotropy_oracle(const SeriesTable& series, std::size_t first, const Rods& rods, const Columns& stress) {
    const double B = moment_anisotropy(rods.length.front() / rods.diameter.front());
    const Columns order = window_columns(series, first, order_tensor_column_names);
    const MeanDirector director = mean_director(order);
    const auto of_stress = [&](std::span<const double> means) {
        const Mat3 tensor = stress_of(means);
        const double parallel = along(tensor, director.direction);
        return 2.0 * parallel / (trace(tensor) - parallel);
    };
    const auto of_order = [&](std::span<const double> means) {  // order tensor, Z
        const double S = along(order_of(means), director.direction);
        return (means[6] - 1.0 + 2.0 * B * S) / (means[6] - 1.0 - B * S);
    };
    Columns order_and_Z = order;
    order_and_Z.push_back(from_row(series.column("Z"), first));
    Columns all = stress;
    all.insert(all.end(), order_and_Z.begin(), order_and_Z.end());

    const Estimate measured = jackknife(stress, of_stress);
    const Estimate predicted = jackknife(order_and_Z, of_order);
    // In a nematic, order and stress fluctuate together. The mean order of an isotropic run is chance, and slow: the
    // part of it that the stress follows is between none, in a dilute state, and all, close to the transition.
    double expected = predicted.value;
    std::optional<double> error;
    if (director.order < nematic_above) {
        expected = std::clamp(measured.value, 1.0, std::max(1.0, predicted.value));
        error = measured.standard_error;
    } else {
        error = jackknife(all, [&](std::span<const double> means) {
                    return of_stress(means.first(9)) - of_order(means.subspan(9));
                }).standard_error;
    }
    const double difference = measured.value - expected;
    return {{"measured", described(measured)},
            {"predicted", described(predicted)},
            {"difference", std::isfinite(difference) ? Json(difference) : Json(nullptr)},
            {"standard_error", optional_number(error)},
            {"agree", error ? Json(std::fabs(difference) <= agreement * *error) : Json(nullptr)}};
}

}  // namespace

ProductionWindow production_window(const Scene& scene, const SeriesTable& series) {
    const std::vector<double>& time = series.column("time");
    ProductionWindow window;
    if (scene.time.equilibration) {
        window.equilibration_time = *scene.time.equilibration;
        // Rows are means over the steps before them: the first of the window begins at the end of equilibration or
        // later.
        const auto begin_of = [&](std::size_t row) { return row == 0 ? 0.0 : time[row - 1]; };
        while (window.first_row < time.size() && begin_of(window.first_row) < window.equilibration_time * (1.0 - 1e-12))
            ++window.first_row;
        return window;
    }
    // The order may still be drifting when the pressure has settled, so the later start counts. But its own slow
    // fluctuations leave few independent samples even in equilibrium: whether it was reached, the pressure says.
    const Equilibration by_pressure = detect_equilibration(series.column("pressure_collision"));
    const Equilibration by_order = detect_equilibration(series.column("nematic_order"));
    window.first_row = std::max(by_pressure.start, by_order.start);
    window.equilibrated = by_pressure.reached;
    window.equilibration_time = window.first_row == 0 ? 0.0 : time[window.first_row - 1];
    return window;
}

Json summarise(const Scene& scene, const Simulation& simulation, const SeriesTable& series, double run_max_overlap) {
    const ProductionWindow window = production_window(scene, series);
    const std::size_t first = window.first_row;
    const std::string stress_unit = unit_of(scene, dimension::stress);
    const Rods& rods = simulation.rods();
    const bool thermal = simulation.settings().kT > 0.0, grows = scene.growth.rate > 0.0;
    const auto average_of = [&](const char* name) { return average(from_row(series.column(name), first)); };
    const Columns stress = window_columns(series, first, stress_column_names);

    Json summary;
    summary["volume_fraction"] = total_volume(rods) / simulation.box().volume();
    summary["rods"] = rods.size();
    summary["steps"] = simulation.clock().step;
    summary["time"] = simulation.clock().time;
    summary["time_step"] = simulation.settings().time_step;
    if (thermal) summary["Z"] = described(average_of("Z"), "");
    summary["pressure"] = described(average_of("pressure"), stress_unit);
    summary["pressure_collision"] = described(average_of("pressure_collision"), stress_unit);
    summary["stress_collision"] = tensor_entry(stress, stress_unit);
    summary["stress_kinetic"] = {{"mean", (grows ? average_of("N").mean : static_cast<double>(rods.size())) /
                                              simulation.box().volume() * simulation.settings().kT},
                                 {"unit", stress_unit},
                                 {"definition", "n kT, on the diagonal"}};
    if (!scene.springs.file.empty()) {
        summary["pressure_springs"] = described(average_of("pressure_springs"), stress_unit);
        summary["stress_springs"] =
            tensor_entry(window_columns(series, first, spring_stress_column_names), stress_unit);
    }
    if (scene.motion.self_propulsion != 0.0) summarise_active_stress(series, first, stress_unit, summary);
    summary["principal_stresses_collision"] = {{"mean", mean_principal_stresses(stress)}, {"unit", stress_unit}};
    if (scene.output.stress_conventions)
        for (const auto& [name, columns] : {std::pair{"centre_of_mass", centre_of_mass_column_names},
                                            std::pair{"centre_line", centre_line_column_names}}) {
            const Columns other = window_columns(series, first, columns);
            summary["stress_conventions"][name] = tensor_entry(other, stress_unit);
            summary["stress_conventions"][name]["anisotropy"] = described(jackknife(other, eigenvalue_ratio));
        }
    summary["nematic_order"] = described(average_of("nematic_order"), "");
    const Vec3 director = mean_director(window_columns(series, first, order_tensor_column_names)).direction;
    summary["director"] = {director.x, director.y, director.z};
    summary["anisotropy"] = described(jackknife(stress, eigenvalue_ratio));
    summary["equilibration_time"] = window.equilibration_time;
    summary["equilibrated"] = window.equilibrated;
    summary["production_rows"] = series.rows() - std::min(first, series.rows());
    summary["max_overlap"] = run_max_overlap / smallest_diameter(scene, rods);
    Json oracles = Json::object();
    const bool free = scene.motion.self_propulsion == 0.0 && scene.springs.file.empty();
    if (thermal && free && !grows && all_alike(rods))
        oracles["anisotropy"] = anisotropy_oracle(series, first, rods, stress);
    summary["oracles"] = oracles;
    const Average number = average_of("N");
    if (number.standard_deviation > 0.0 && !number.standard_error)
        withhold_errors(summary, "The number of cells changes throughout: averages are of no state that lasts.");
    return summary;
}

std::string summary_text(const Json& summary) {
    std::string text;
    const auto line = [&](const Json& entry, const char* name) {
        if (entry.is_null()) return;
        const std::string unit = entry.value("unit", "");
        const std::string mean =
            entry["mean"].is_null() ? "not defined" : fmt::format("{:.5g}", entry["mean"].get<double>());
        if (entry["standard_error"].is_null())
            text += fmt::format("{:20} = {} {} (no error bar: {})\n", name, mean, unit,
                                entry.value("no_standard_error_because", "not defined"));
        else
            text += fmt::format("{:20} = {} +- {:.2g} {} (n_eff {:.0f})\n", name, mean,
                                entry["standard_error"].get<double>(), unit, entry["n_eff"].get<double>());
    };
    const auto entry = [&](const char* key) { return summary.value(key, Json()); };
    line(entry("Z"), "Z");
    line(entry("pressure"), "pressure");
    line(entry("pressure_collision"), "collision pressure");
    line(entry("pressure_springs"), "pressure of springs");
    line(entry("pressure_active"), "active pressure");
    line(entry("nematic_order"), "nematic order S");
    line(entry("anisotropy"), "stress anisotropy");
    if (summary["oracles"].contains("anisotropy")) {
        line(summary["oracles"]["anisotropy"]["measured"], "  along over across");
        line(summary["oracles"]["anisotropy"]["predicted"], "  as equilibrium has");
    }
    text +=
        fmt::format("{:20} = {:.4g}{}\n", "equilibration time", summary["equilibration_time"].get<double>(),
                    summary["equilibrated"].get<bool>() ? "" : "   WARNING: equilibrium was not reached; run longer");
    text += fmt::format("{:20} = {:.2e} D\n", "largest overlap", summary["max_overlap"].get<double>());
    if (summary["oracles"].contains("anisotropy")) {
        const Json& oracle = summary["oracles"]["anisotropy"];
        if (oracle["agree"] == Json(false))
            text += fmt::format(
                "WARNING: the stress anisotropy differs from that of equilibrium by {:.3g} +- {:.2g}: the run may be "
                "too short, its steps too long, or the box a bad fit to layers of rods\n",
                oracle["difference"].get<double>(), oracle["standard_error"].get<double>());
    }
    return text;
}
