#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "jostle/disk/checksum.hpp"
#include "jostle/disk/durable_file.hpp"

namespace jostle {

/// One column of series.csv, told so that a reader needs nothing else.
struct SeriesColumn {
    std::string name;        ///< as in the header line
    std::string unit;        ///< factors separated by spaces, signed powers: "pN um-2"; "1" for a pure number
    std::string symbol;      ///< as in docs/notation
    std::string definition;  ///< one sentence
    std::string sign;        ///< sign convention, empty where none is needed
};

/// Throws InputError if the first `bytes` bytes of a table do not have this checksum; what its columns are does not
/// matter.
void require_same_bytes(const std::string& path, std::uint64_t bytes, std::uint64_t hash);

/// series.csv while it is written: a header line, then one row per output step.
///
/// Every row is one write(2) of one line; a number is written with the fewest digits that give back the same double,
/// so whole numbers look whole. The checksum of all bytes so far goes into the checkpoint.
class SeriesFile {
public:
    /// A new file with its header line; what `path` held is gone. Errors: DiskError.
    static SeriesFile create(const std::string& path, std::vector<SeriesColumn> columns);

    /// Goes on after the first `bytes` bytes, whose checksum must be `hash`; what follows them is cut off.
    ///
    /// All checks come before the cut. Errors: InputError if the file is missing, shorter, changed or has other
    /// columns; DiskError.
    static SeriesFile resume(const std::string& path, std::vector<SeriesColumn> columns, std::uint64_t bytes,
                             std::uint64_t hash);

    /// The checks of `resume` alone, for looking at several files before one of them is cut. Errors: as there.
    static void require_prefix(const std::string& path, const std::vector<SeriesColumn>& columns, std::uint64_t bytes,
                               std::uint64_t hash);

    /// One row, (columns) long. Errors: DiskError, after which the file ends with the row before.
    void append(std::span<const double> row);

    /// Returns when all rows are on the disk. Errors: DiskError.
    void sync() { file_.sync(); }

    std::uint64_t bytes() const { return file_.size(); }
    std::uint64_t hash() const { return checksum_.value(); }
    const std::vector<SeriesColumn>& columns() const { return columns_; }

private:
    SeriesFile(AppendFile file, std::vector<SeriesColumn> columns);
    void append_line(const std::string& line);

    AppendFile file_;
    std::vector<SeriesColumn> columns_;
    RunningChecksum checksum_;
};

/// The numbers of a series.csv.
struct SeriesTable {
    std::string path;
    std::vector<std::string> names;            ///< (columns)
    std::vector<std::vector<double>> columns;  ///< (columns)(rows)

    std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }

    /// The column of that name. Errors: InputError.
    const std::vector<double>& column(const std::string& name) const;
};

/// Reads a series.csv; a last line without its end, as a kill leaves it, is passed over.
/// Errors: InputError with the line and column of a number that is none; DiskError.
SeriesTable read_series(const std::string& path);

/// The text of series.json, or of NAME.json beside another table NAME.csv: for every column its unit, symbol,
/// definition and sign convention.
std::string series_description(const std::string& name, const std::vector<SeriesColumn>& columns);

}  // namespace jostle
