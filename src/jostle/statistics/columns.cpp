#include "jostle/statistics/columns.hpp"

#include <string>

#include "jostle/error/refuse.hpp"

namespace jostle {

void require_columns(std::span<const std::vector<double>> columns) {
    const auto refuse_columns = [](std::string value, const char* problem) {
        refuse("columns", std::move(value), problem, "at least one column, all of one length");
    };
    if (columns.empty()) refuse_columns("none", "there is nothing to average");
    for (const auto& column : columns)
        if (column.size() != columns[0].size())
            refuse_columns(std::to_string(columns[0].size()) + " and " + std::to_string(column.size()) + " rows",
                           "columns differ in length");
}

}  // namespace jostle
