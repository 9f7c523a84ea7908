#pragma once

#include "jostle/tables/table.hpp"

namespace jostle {

/// `read_table` of a CSV file.
Table read_csv_table(const std::string& path, const KnownColumns& known);

}  // namespace jostle
