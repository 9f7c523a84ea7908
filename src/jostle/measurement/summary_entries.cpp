#include "jostle/measurement/summary_entries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace jostle {

namespace {

using Json = nlohmann::ordered_json;

void set_null(Json& entry) {
    if (!entry.is_array()) entry = nullptr;
    for (Json& element : entry) set_null(element);
}

}  // namespace

std::vector<double> from_row(const std::vector<double>& column, std::size_t first) {
    return {column.begin() + static_cast<std::ptrdiff_t>(std::min(first, column.size())), column.end()};
}

double column_mean(const std::vector<double>& column) {
    return average(column).mean;
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

Json described(const EquilibriumCheck& check) {
    const auto if_any = [](double time) { return time > 0.0 && std::isfinite(time) ? Json(time) : Json(nullptr); };
    Json entry = {{"verdict", in_words(check.verdict)}, {"in_words", in_words(check)}};
    if (!check.reason.empty()) entry["reason"] = check.reason;
    entry["rotation_time"] = if_any(check.rotation_time);
    entry["rotation_times"] = if_any(check.rotation_times);
    entry["diffusion_times"] = if_any(check.diffusion_times);
    entry["passing_times"] = if_any(check.passing_times);
    entry["spreading_times"] = if_any(check.spreading_times);
    entry["volume_relaxation_times"] = if_any(check.volume_times);
    entry["spring_relaxation_times"] = if_any(check.spring_times);
    return entry;
}

double without_rounding(double value) {
    return std::stod(fmt::format("{:.12g}", value));
}

Json tensor_entry(const Columns& columns, const std::string& unit,
                  const std::function<Average(const std::vector<double>&)>& average_of) {
    Json mean = Json::array(), error = Json::array();
    for (std::size_t a = 0; a < 3; ++a) {
        Json mean_row = Json::array(), error_row = Json::array();
        for (std::size_t b = 0; b < 3; ++b) {
            const Average element = average_of(columns[3 * a + b]);
            mean_row.push_back(element.mean);
            error_row.push_back(optional_number(element.standard_error));
        }
        mean.push_back(mean_row);
        error.push_back(error_row);
    }
    return {{"mean", mean}, {"standard_error", error}, {"unit", unit}};
}

void withhold_errors(Json& entry, const std::string& reason) {
    if (!entry.is_object()) return;
    if (entry.contains("no_standard_error_because") && entry["mean"].is_null()) return;  // it has a reason of its own
    if (entry.contains("agree")) {  // a check that fails is told all the same
        if (entry["agree"] == Json(true)) entry["agree"] = nullptr;
    } else if (entry.contains("standard_error")) {
        set_null(entry["standard_error"]);
        entry["no_standard_error_because"] = reason;
    }
    for (Json& part : entry) withhold_errors(part, reason);
}

}  // namespace jostle
