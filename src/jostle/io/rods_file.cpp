#include "jostle/io/rods_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "jostle/io/durable_file.hpp"

namespace jostle {

namespace {

constexpr std::array<std::string_view, 8> known_columns = {"x", "y", "z", "nx", "ny", "nz", "length", "diameter"};
constexpr std::size_t required_columns = 6;

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

/// Which cell of a line holds each of `known_columns`.
using Columns = std::array<std::optional<std::size_t>, known_columns.size()>;

Columns columns_of(const std::string& path, std::string_view header) {
    Columns columns;
    const auto names = cells_of(header);
    for (std::size_t cell = 0; cell < names.size(); ++cell) {
        const auto known = std::find(known_columns.begin(), known_columns.end(), names[cell]);
        if (known == known_columns.end())
            throw refused_file(path, fmt::format("\"{}\" is no column of a rods file", names[cell]),
                               "The header names the columns x,y,z,nx,ny,nz and optionally length,diameter", 1);
        auto& column = columns[static_cast<std::size_t>(known - known_columns.begin())];
        if (column) throw refused_file(path, fmt::format("the column \"{}\" stands twice", names[cell]), "", 1);
        column = cell;
    }
    for (std::size_t k = 0; k < required_columns; ++k)
        if (!columns[k])
            throw refused_file(path, fmt::format("the column \"{}\" is missing", known_columns[k]),
                               "The header names the columns x,y,z,nx,ny,nz and optionally length,diameter", 1);
    return columns;
}

double number(const std::string& path, int line, std::string_view name, std::string_view text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
        throw refused_file(path, fmt::format("{} = \"{}\" is not a finite number", name, text), "", line);
    return value;
}

}  // namespace

Rods read_rods(const std::string& path, double default_length, double default_diameter) {
    const std::string content = read_file(path);
    std::string_view rest = content;
    Rods rods;
    Columns columns;
    for (int line = 1; !rest.empty(); ++line) {
        const auto end = rest.find('\n');
        const std::string_view text = trimmed(rest.substr(0, end));
        rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
        if (line == 1) {
            columns = columns_of(path, text);
            continue;
        }
        if (text.empty()) continue;
        const auto cells = cells_of(text);
        std::array<double, known_columns.size()> values{0, 0, 0, 0, 0, 0, default_length, default_diameter};
        for (std::size_t k = 0; k < values.size(); ++k) {
            if (!columns[k]) continue;
            if (*columns[k] >= cells.size())
                throw refused_file(path,
                                   fmt::format("{} cells, but column \"{}\" is the {}th", cells.size(),
                                               known_columns[k], *columns[k] + 1),
                                   "Was the file cut short?", line);
            values[k] = number(path, line, known_columns[k], cells[*columns[k]]);
        }
        const Vec3 axis{values[3], values[4], values[5]};
        if (!(norm(axis) > 1e-12)) throw refused_file(path, "the axis (nx, ny, nz) has no direction", "", line);
        if (values[6] < 0.0) throw refused_file(path, fmt::format("length = {} is negative", values[6]), "", line);
        if (!(values[7] > 0.0))
            throw refused_file(path, fmt::format("diameter = {} is not positive", values[7]), "", line);
        rods.push_back(rods.size(), {values[0], values[1], values[2]}, normalised(axis), values[6], values[7]);
    }
    if (rods.size() == 0) throw refused_file(path, "the file holds no rods", "");
    return rods;
}

}  // namespace jostle
