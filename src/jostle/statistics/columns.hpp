#pragma once

#include <span>
#include <vector>

namespace jostle {

/// Throws InputError if there is no column, or if lengths differ. `columns` (columns, rows).
void require_columns(std::span<const std::vector<double>> columns);

}  // namespace jostle
