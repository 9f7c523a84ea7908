#include "jostle/statistics/columns.hpp"

#include <string>

#include "jostle/error/input_error.hpp"

namespace jostle {

void require_columns(std::span<const std::vector<double>> columns) {
    const auto refuse = [](std::string value, const char* problem) {
        throw InputError({.key = "columns",
                          .value = std::move(value),
                          .problem = problem,
                          .allowed = "at least one column, all of one length",
                          .suggestion = "",
                          .place = {}});
    };
    if (columns.empty()) refuse("none", "there is nothing to average");
    for (const auto& column : columns)
        if (column.size() != columns[0].size())
            refuse(std::to_string(columns[0].size()) + " and " + std::to_string(column.size()) + " rows",
                   "columns differ in length");
}

}  // namespace jostle
