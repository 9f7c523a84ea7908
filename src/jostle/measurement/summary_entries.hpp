#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "jostle/run_files/series_file.hpp"
#include "jostle/statistics/equilibrium_check.hpp"
#include "jostle/statistics/jackknife.hpp"
#include "jostle/statistics/time_series.hpp"

namespace jostle {

/// Columns of a series: (columns)(rows).
using Columns = std::vector<std::vector<double>>;

/// The rows of a column from `first` on.
std::vector<double> from_row(const std::vector<double>& column, std::size_t first);

/// The mean of a column, of any length.
double column_mean(const std::vector<double>& column);

/// The rows from `first` on of the columns of these names.
Columns window_columns(const SeriesTable& series, std::size_t first, std::span<const char* const> names);

/// How summary.json tells an average: mean, standard error or the reason that there is none, and what they rest on.
nlohmann::ordered_json described(const Average& average, const std::string& unit);
nlohmann::ordered_json described(const Estimate& estimate);

nlohmann::ordered_json described(const EquilibriumCheck& check);

/// A number, or null.
nlohmann::ordered_json optional_number(const std::optional<double>& value);

/// 0.3, where the volumes of rods and box give 0.3000000000000014.
double without_rounding(double value);

/// Mean and standard error of each of nine columns, by rows of the tensor. `average_of`: how a column is averaged.
nlohmann::ordered_json tensor_entry(const Columns& columns, const std::string& unit,
                                    const std::function<Average(const std::vector<double>&)>& average_of);

/// Takes all error bars out of an entry and its parts, and gives the reason instead. A check of theory that agrees is
/// no longer said to; one that fails still is.
void withhold_errors(nlohmann::ordered_json& entry, const std::string& reason);

}  // namespace jostle
