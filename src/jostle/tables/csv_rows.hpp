#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace jostle {

/// The columns that a CSV file of a scene may have, by name; the first `required` of them must be there.
struct CsvColumns {
    std::span<const std::string_view> names;
    std::size_t required = 0;
    std::string_view file;    ///< as in messages: "a rods file"
    std::string_view header;  ///< what to do about a wrong header
};

/// Reads a CSV file: a header line that names columns in any order, perhaps after a "#", then one row a line; empty
/// lines are passed over.
///
/// Calls row(line, values) with `values` in the order of `columns.names`, without a value where the file has no such
/// column. Errors: InputError with line and column for anything missing, unknown or not a finite number; DiskError.
void for_each_csv_row(const std::string& path, const CsvColumns& columns,
                      const std::function<void(int line, std::span<const std::optional<double>> values)>& row);

}  // namespace jostle
