#include "jostle/tables/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "jostle/disk/durable_file.hpp"
#include "jostle/error/nearest_word.hpp"
#include "jostle/error/one_line.hpp"
#include "jostle/math/range.hpp"
#include "jostle/tables/csv_table.hpp"
#include "jostle/tables/hdf5_table.hpp"

namespace jostle {

namespace {

bool is_hdf5(const std::string& path) {
    const std::string signature = "\x89HDF\r\n\x1a\n";
    std::string bytes;
    ReadFile(path).read_up_to(signature.size(), bytes);
    return bytes == signature;
}

[[noreturn]] void refuse_missing(const Table& table, const std::vector<std::string>& missing) {
    std::string guess;
    for (const std::string& name : missing) {
        const std::string nearest = nearest_word(name, table.names);
        const bool known = std::find(missing.begin(), missing.end(), nearest) != missing.end() || table.has(nearest);
        if (!nearest.empty() && !known) guess += fmt::format(". Is \"{}\" meant for \"{}\"?", nearest, name);
    }
    throw refused_file(table.path,
                       fmt::format("the column{} {} {} missing", missing.size() > 1 ? "s" : "", quoted_list(missing),
                                   missing.size() > 1 ? "are" : "is"),
                       fmt::format("The file has {}{}", quoted_list(table.names), guess));
}

/// Larger numbers, multiplied, would leave the range of doubles; smaller ones only vanish beside others.
void note_beyond_range(Table& table) {
    for (const auto& [name, column] : table.numbers)
        for (std::size_t row = 0; row < table.rows; ++row)
            if (std::fabs(column[row]) > Range::largest)
                table.problems.add(row, std::isinf(column[row])
                                            ? fmt::format("{} is infinite", name)
                                            : fmt::format("{} = {:g} is beyond 1e30 in size", name, column[row]));
}

std::vector<std::string> with_suffixes(const std::string& name, std::initializer_list<const char*> suffixes) {
    std::vector<std::string> columns;
    for (const char* suffix : suffixes) columns.push_back(name + suffix);
    return columns;
}

}  // namespace

bool Table::has_all(const std::vector<std::string>& columns) const {
    const bool some = std::any_of(columns.begin(), columns.end(), [&](const auto& name) { return has(name); });
    if (some) require(columns);
    return some;
}

void Table::require(const std::vector<std::string>& columns) const {
    std::vector<std::string> missing;
    for (const std::string& name : columns)
        if (!has(name)) missing.push_back(name);
    if (!missing.empty()) refuse_missing(*this, missing);
}

void Table::require_filled(const std::vector<std::string>& columns) {
    for (const std::string& name : columns) {
        const std::vector<double>& column = numbers.at(name);
        for (std::size_t row = 0; row < rows; ++row)
            if (std::isnan(column[row]) && !problems.has(row)) problems.add(row, fmt::format("{} is not given", name));
    }
}

std::vector<std::string> Table::passed_over(const KnownColumns& known) const {
    std::vector<std::string> others;
    for (const std::string& name : names)
        if (std::find(known.numbers.begin(), known.numbers.end(), name) == known.numbers.end() &&
            std::find(known.words.begin(), known.words.end(), name) == known.words.end())
            others.push_back(on_one_line(name));
    return others;
}

Table read_table(const std::string& path, const KnownColumns& known) {
    Table table = is_hdf5(path) ? read_hdf5_table(path, known) : read_csv_table(path, known);
    table.units = {on_one_line(table.units.length), on_one_line(table.units.force)};
    note_beyond_range(table);
    return table;
}

std::vector<std::string> vector_columns(const std::string& name) {
    return with_suffixes(name, {"_x", "_y", "_z"});
}

std::vector<std::string> tensor_columns(const std::string& name) {
    return with_suffixes(name, {"_xx", "_xy", "_xz", "_yy", "_yz", "_zz"});
}

VectorColumn::VectorColumn(const Table& table, const std::vector<std::string>& columns) {
    for (const std::string& name : columns)
        if (table.numbers.contains(name)) columns_.push_back(&table.numbers.at(name));
}

Vec3 VectorColumn::operator[](std::size_t row) const {
    if (columns_.empty()) return {};
    return {(*columns_[0])[row], (*columns_[1])[row], (*columns_[2])[row]};
}

}  // namespace jostle
