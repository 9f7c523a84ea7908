#include "jostle/tables/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string_view>

#include "jostle/disk/durable_file.hpp"
#include "jostle/error/one_line.hpp"
#include "jostle/tables/csv_cells.hpp"

namespace jostle {

namespace {

/// "# length_unit: um", "# force_unit: pN"; any other comment says nothing.
void read_comment(std::string_view line, TableUnits& units) {
    const std::string_view text = trimmed(line.substr(1));
    const auto colon = text.find(':');
    if (colon == std::string_view::npos) return;
    const std::string_view key = trimmed(text.substr(0, colon)), value = trimmed(text.substr(colon + 1));
    if (key == "length_unit") units.length = value;
    if (key == "force_unit") units.force = value;
}

/// Whether a comment is a header as NumPy's savetxt writes it: it names two known columns at least.
bool is_header(std::string_view line, const KnownColumns& known) {
    std::vector<std::string_view> cells;
    split_cells(without_sign(line), cells);
    const auto has = [](const auto& names, std::string_view cell) {
        return std::find(names.begin(), names.end(), cell) != names.end();
    };
    return std::count_if(cells.begin(), cells.end(),
                         [&](std::string_view cell) { return has(known.numbers, cell) || has(known.words, cell); }) > 1;
}

/// Where the cells of a row go: to a column of numbers, of words, or nowhere.
struct Target {
    std::string name;
    std::vector<double>* numbers = nullptr;
    std::vector<std::string>* words = nullptr;
};

std::vector<Target> read_header(Table& table, std::string_view line, int number, const KnownColumns& known) {
    std::vector<std::string_view> cells;
    split_cells(line, cells);
    std::vector<Target> targets;
    for (const std::string_view cell : cells) {
        Target target{std::string(cell)};
        if (std::find(table.names.begin(), table.names.end(), cell) != table.names.end())
            throw refused_file(table.path, fmt::format("the column \"{}\" stands twice", on_one_line(cell)), "",
                               number);
        table.names.push_back(target.name);
        if (std::find(known.numbers.begin(), known.numbers.end(), cell) != known.numbers.end())
            target.numbers = &table.numbers[target.name];
        if (std::find(known.words.begin(), known.words.end(), cell) != known.words.end())
            target.words = &table.words[target.name];
        targets.push_back(std::move(target));
    }
    return targets;
}

/// The number of a cell; nan, and a problem of its row, if it is none.
double number_in(std::string_view cell, const std::string& name, Table& table) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (cell.empty()) return none;
    if (const auto value = number_of_cell(cell)) return *value;
    table.problems.add(table.rows, fmt::format("{} = \"{}\" is not a finite number", name, on_one_line(cell)));
    return none;
}

void add_row(Table& table, const std::vector<Target>& targets, const std::vector<std::string_view>& cells) {
    if (cells.size() != targets.size())
        table.problems.add(table.rows, fmt::format("{} cells, but the header names {}", cells.size(), targets.size()));
    for (std::size_t k = 0; k < targets.size(); ++k) {
        const std::string_view cell = cells.size() == targets.size() ? cells[k] : std::string_view{};
        if (targets[k].numbers) targets[k].numbers->push_back(number_in(cell, targets[k].name, table));
        if (targets[k].words) targets[k].words->emplace_back(cell);
    }
    ++table.rows;
}

}  // namespace

Table read_csv_table(const std::string& path, const KnownColumns& known) {
    const std::string content = read_file(path);
    std::string_view rest = content;
    if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);  // what some programs put before UTF-8
    Table table(path);
    std::vector<Target> targets;
    std::vector<std::string_view> cells;
    for (int number = 1; !rest.empty(); ++number) {
        const std::string_view line = next_line(rest);
        if (line.empty()) continue;
        if (line.front() == '#' && targets.empty() && is_header(line, known)) {
            targets = read_header(table, without_sign(line), number, known);
        } else if (line.front() == '#') {
            read_comment(line, table.units);
        } else if (targets.empty()) {
            targets = read_header(table, line, number, known);
        } else {
            split_cells(line, cells);
            table.problems.line.push_back(number);
            add_row(table, targets, cells);
        }
    }
    if (targets.empty())
        throw refused_file(path, "there is no header line", "The first line names the columns, parted by commas");
    return table;
}

}  // namespace jostle
