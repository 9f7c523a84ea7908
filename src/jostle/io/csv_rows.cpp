#include "jostle/io/csv_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "jostle/io/durable_file.hpp"

namespace jostle {

namespace {

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> cells_of(std::string_view line) {
    std::vector<std::string_view> cells;
    for (std::size_t begin = 0;;) {
        const auto end = line.find(',', begin);
        cells.push_back(trimmed(line.substr(begin, end - begin)));
        if (end == std::string_view::npos) return cells;
        begin = end + 1;
    }
}

/// Which cell of a line holds each column.
using Places = std::vector<std::optional<std::size_t>>;

Places places_of(const std::string& path, const CsvColumns& columns, std::string_view header) {
    Places places(columns.names.size());
    const auto names = cells_of(header);
    for (std::size_t cell = 0; cell < names.size(); ++cell) {
        const auto known = std::find(columns.names.begin(), columns.names.end(), names[cell]);
        if (known == columns.names.end())
            throw refused_file(path, fmt::format("\"{}\" is no column of {}", names[cell], columns.file),
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
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
        throw refused_file(path, fmt::format("{} = \"{}\" is not a finite number", name, text), "", line);
    return value;
}

}  // namespace

void for_each_csv_row(const std::string& path, const CsvColumns& columns,
                      const std::function<void(int, std::span<const std::optional<double>>)>& row) {
    const std::string content = read_file(path);
    std::string_view rest = content;
    Places places;
    std::vector<std::optional<double>> values(columns.names.size());
    for (int line = 1; !rest.empty(); ++line) {
        const auto end = rest.find('\n');
        const std::string_view text = trimmed(rest.substr(0, end));
        rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
        if (line == 1) {
            places = places_of(path, columns, text);
            continue;
        }
        if (text.empty()) continue;
        const auto cells = cells_of(text);
        for (std::size_t k = 0; k < values.size(); ++k) {
            if (!places[k]) continue;
            if (*places[k] >= cells.size())
                throw refused_file(path,
                                   fmt::format("{} cells, but column \"{}\" is the {}th", cells.size(),
                                               columns.names[k], *places[k] + 1),
                                   "Was the file cut short?", line);
            values[k] = number(path, line, columns.names[k], cells[*places[k]]);
        }
        row(line, values);
    }
}

}  // namespace jostle
