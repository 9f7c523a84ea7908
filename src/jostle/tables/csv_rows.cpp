#include "jostle/tables/csv_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "jostle/disk/durable_file.hpp"
#include "jostle/error/one_line.hpp"
#include "jostle/math/range.hpp"
#include "jostle/tables/csv_cells.hpp"

namespace jostle {

namespace {

/// Which cell of a line holds each column.
using Places = std::vector<std::optional<std::size_t>>;

Places places_of(const std::string& path, const CsvColumns& columns, std::string_view header) {
    Places places(columns.names.size());
    std::vector<std::string_view> names;
    split_cells(without_sign(header), names);
    for (std::size_t cell = 0; cell < names.size(); ++cell) {
        const auto known = std::find(columns.names.begin(), columns.names.end(), names[cell]);
        if (known == columns.names.end())
            throw refused_file(path, fmt::format("\"{}\" is no column of {}", on_one_line(names[cell]), columns.file),
                               std::string(columns.header), 1);
        auto& place = places[static_cast<std::size_t>(known - columns.names.begin())];
        if (place) throw refused_file(path, fmt::format("the column \"{}\" stands twice", names[cell]), "", 1);
        place = cell;
    }
    for (std::size_t k = 0; k < columns.required; ++k)
        if (!places[k])
            throw refused_file(path, fmt::format("the column \"{}\" is missing", columns.names[k]),
                               std::string(columns.header), 1);
    return places;
}

double number(const std::string& path, int line, std::string_view name, std::string_view text) {
    const auto value = number_of_cell(text);
    if (!value)
        throw refused_file(path, fmt::format("{} = \"{}\" is not a finite number", name, on_one_line(text)), "", line);
    const double magnitude = std::fabs(*value);
    if (magnitude != 0.0 && !(magnitude >= Range::smallest && magnitude <= Range::largest))
        throw refused_file(path, fmt::format("{} = {} does not lie within 1e-30 and 1e30", name, on_one_line(text)), "",
                           line);
    return *value;
}

}  // namespace

void for_each_csv_row(const std::string& path, const CsvColumns& columns,
                      const std::function<void(int, std::span<const std::optional<double>>)>& row) {
    const std::string content = read_file(path);
    std::string_view rest = content;
    if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);  // what some programs put before UTF-8
    Places places;
    std::size_t width = 0;  // of a line, in cells: the header names each column once
    std::vector<std::string_view> cells;
    std::vector<std::optional<double>> values(columns.names.size());
    for (int line = 1; !rest.empty(); ++line) {
        const std::string_view text = next_line(rest);
        if (line == 1) {
            places = places_of(path, columns, text);
            width = static_cast<std::size_t>(
                std::count_if(places.begin(), places.end(), [](const auto& p) { return p.has_value(); }));
            continue;
        }
        if (text.empty()) continue;
        split_cells(text, cells);
        if (cells.size() != width)
            throw refused_file(path, fmt::format("{} cells, but the header names {}", cells.size(), width),
                               cells.size() < width ? "Was the file cut short?" : "Numbers have points, not commas",
                               line);
        for (std::size_t k = 0; k < values.size(); ++k) {
            if (!places[k]) continue;
            values[k] = number(path, line, columns.names[k], cells[*places[k]]);
        }
        row(line, values);
    }
}

}  // namespace jostle
