#include "jostle/run_files/series_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

namespace jostle {
namespace {

constexpr std::uint64_t block_bytes = 1 << 20;

std::string header_line(const std::vector<SeriesColumn>& columns) {
    std::string line;
    for (const SeriesColumn& column : columns) {
        if (!line.empty()) line += ',';
        line += column.name;
    }
    return line + '\n';
}

/// Reads the first `bytes` bytes into the checksum; returns as many of them as a header line of `header_size` has.
std::string add_prefix(const std::string& path, std::uint64_t bytes, std::size_t header_size,
                       RunningChecksum& checksum) {
    ReadFile file(path);
    if (file.size() < bytes)
        throw refused_file(
            path, fmt::format("the series is truncated: it has {} bytes, the checkpoint needs {}", file.size(), bytes),
            "Put the file back, or start again with --fresh");
    std::string header, block;
    for (std::uint64_t rest = bytes; rest > 0; rest -= block.size()) {
        file.read_up_to(std::min(rest, block_bytes), block);
        if (block.empty()) break;
        checksum.add(block);
        if (header.size() < header_size) header += block.substr(0, header_size - header.size());
    }
    return header;
}

/// Adds the first `bytes` bytes to the checksum, which must be those of the checkpoint; returns the beginning, as
/// above.
std::string add_checked_prefix(const std::string& path, std::uint64_t bytes, std::uint64_t hash,
                               std::size_t header_size, RunningChecksum& checksum) {
    std::string header = add_prefix(path, bytes, header_size, checksum);
    if (checksum.value() != hash)
        throw refused_file(
            path,
            fmt::format("the series was changed: its first {} bytes have checksum {:016x}, at the checkpoint "
                        "it was {:016x}",
                        bytes, checksum.value(), hash),
            "Put the file back, or start again with --fresh");
    return header;
}

/// The checksum of the first `bytes` bytes, once they are found to be those of the checkpoint, with these columns.
RunningChecksum checked_prefix(const std::string& path, const std::vector<SeriesColumn>& columns, std::uint64_t bytes,
                               std::uint64_t hash) {
    RunningChecksum checksum;
    const std::string header = header_line(columns);
    if (add_checked_prefix(path, bytes, hash, header.size(), checksum) != header)
        throw refused_file(path, "the series has other columns than this version of jostle writes",
                           "Go on with the jostle that wrote it, or start again with --fresh", 1);
    return checksum;
}

double parsed(const std::string& path, int line, const std::string& name, std::string_view word) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || word.empty())
        throw refused_file(path, fmt::format("\"{}\" in column {} is not a number", word, name),
                           "The file was changed or damaged", line);
    return value;
}

std::vector<std::string> split_names(std::string_view line) {
    std::vector<std::string> names;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t comma = std::min(line.find(',', begin), line.size());
        names.emplace_back(line.substr(begin, comma - begin));
        begin = comma + 1;
    }
    return names;
}

void add_row(SeriesTable& table, int line_number, std::string_view line) {
    const std::size_t count = static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
    if (count != table.names.size())
        throw refused_file(table.path,
                           fmt::format("the row has {} numbers, the header names {}", count, table.names.size()),
                           "The file was changed or damaged", line_number);
    std::size_t begin = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t comma = std::min(line.find(',', begin), line.size());
        table.columns[k].push_back(parsed(table.path, line_number, table.names[k], line.substr(begin, comma - begin)));
        begin = comma + 1;
    }
}

}  // namespace

SeriesFile::SeriesFile(AppendFile file, std::vector<SeriesColumn> columns)
    : file_(std::move(file)), columns_(std::move(columns)) {}

void require_same_bytes(const std::string& path, std::uint64_t bytes, std::uint64_t hash) {
    RunningChecksum checksum;
    add_checked_prefix(path, bytes, hash, 0, checksum);
}

SeriesFile SeriesFile::create(const std::string& path, std::vector<SeriesColumn> columns) {
    SeriesFile series(AppendFile(path), std::move(columns));
    series.file_.truncate_to(0);
    series.append_line(header_line(series.columns_));
    return series;
}

SeriesFile SeriesFile::resume(const std::string& path, std::vector<SeriesColumn> columns, std::uint64_t bytes,
                              std::uint64_t hash) {
    RunningChecksum checksum = checked_prefix(path, columns, bytes, hash);
    SeriesFile series(AppendFile(path), std::move(columns));
    series.checksum_ = std::move(checksum);
    series.file_.truncate_to(bytes);
    return series;
}

void SeriesFile::require_prefix(const std::string& path, const std::vector<SeriesColumn>& columns, std::uint64_t bytes,
                                std::uint64_t hash) {
    checked_prefix(path, columns, bytes, hash);
}

void SeriesFile::append(std::span<const double> row) {
    if (row.size() != columns_.size())
        throw std::logic_error(fmt::format("a row of {} numbers for {} columns", row.size(), columns_.size()));
    fmt::memory_buffer line;
    for (const double value : row) {
        if (line.size() > 0) line.push_back(',');
        // The sign of a NaN means nothing and would only differ between processors.
        fmt::format_to(std::back_inserter(line), "{}", std::isnan(value) ? std::fabs(value) : value);
    }
    line.push_back('\n');
    append_line(fmt::to_string(line));
}

void SeriesFile::append_line(const std::string& line) {
    file_.write_all(line);
    checksum_.add(line);
}

const std::vector<double>& SeriesTable::column(const std::string& name) const {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        throw refused_file(path, "the series has no column \"" + name + "\"", "Was it written by another version?", 1);
    return columns[static_cast<std::size_t>(found - names.begin())];
}

SeriesTable read_series(const std::string& path) {
    const std::string content = read_file(path);
    SeriesTable table;
    table.path = path;
    int line_number = 0;
    for (std::size_t begin = 0; begin < content.size();) {
        const std::size_t end = content.find('\n', begin);
        if (end == std::string::npos) break;
        const std::string_view line(content.data() + begin, end - begin);
        if (++line_number == 1) {
            table.names = split_names(line);
            table.columns.resize(table.names.size());
        } else {
            add_row(table, line_number, line);
        }
        begin = end + 1;
    }
    if (line_number == 0)
        throw refused_file(path, "the series is empty: it has no header line", "Is it the right file?");
    return table;
}

std::string series_description(const std::string& name, const std::vector<SeriesColumn>& columns) {
    nlohmann::ordered_json description;
    description["file"] = name + ".csv";
    for (const SeriesColumn& column : columns)
        description["columns"].push_back({{"name", column.name},
                                          {"unit", column.unit},
                                          {"symbol", column.symbol},
                                          {"definition", column.definition},
                                          {"sign", column.sign}});
    return description.dump(2) + "\n";
}

}  // namespace jostle
