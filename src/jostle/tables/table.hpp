#pragma once

#include <map>
#include <string>
#include <vector>

#include "jostle/math/vec3.hpp"
#include "jostle/tables/row_problems.hpp"

// Tables that other programs write: CSV with a header line, or HDF5 with one dataset a column.

namespace jostle {

/// The columns that a reader knows; others are passed over.
struct KnownColumns {
    std::vector<std::string> numbers;
    std::vector<std::string> words;
};

/// The units that a table names, for the eye only; empty where it names none.
struct TableUnits {
    std::string length, force;
};

/// Columns by name, one row a thing.
struct Table {
    explicit Table(std::string file) : path(std::move(file)), problems(path) {}

    std::string path;
    std::vector<std::string> names;                         ///< all columns of the file
    std::map<std::string, std::vector<double>> numbers;     ///< (rows) a known column; nan: an empty cell
    std::map<std::string, std::vector<std::string>> words;  ///< the same of words; "": an empty cell
    std::size_t rows = 0;
    TableUnits units;      ///< on_one_line
    RowProblems problems;  ///< cells that could not be read, and what later looks at the rows find

    bool has(const std::string& name) const { return numbers.contains(name) || words.contains(name); }
    /// Whether all of the columns are there. Throws InputError, with a guess what is meant, where only some are.
    bool has_all(const std::vector<std::string>& columns) const;
    /// Throws InputError that names the columns that are missing, those of the file, and a guess.
    void require(const std::vector<std::string>& columns) const;
    /// Every empty cell of these columns becomes a problem of its row.
    void require_filled(const std::vector<std::string>& columns);
    /// The columns of the file that `known` lacks, each on_one_line.
    std::vector<std::string> passed_over(const KnownColumns& known) const;
};

/// Reads CSV or HDF5, whichever the file is.
///
/// CSV: lines that begin with # are passed over, but for "# length_unit: um" and "# force_unit: pN"; then a header line
/// with the columns' names, perhaps after a "#", then one row a line; cells are parted by commas, and may stand in
/// quotes. HDF5: datasets of one dimension in the root group; the units are attributes of the root group. Cells that
/// are no finite numbers and numbers beyond 1e30 in size and rows of another length than the header become `problems`.
/// HDF5 is read in a child process (bytes_from_child.hpp). Errors: InputError for what is no such table; DiskError.
Table read_table(const std::string& path, const KnownColumns& known);

/// NAME_x, NAME_y, NAME_z.
std::vector<std::string> vector_columns(const std::string& name);

/// NAME_xx, NAME_xy, NAME_xz, NAME_yy, NAME_yz, NAME_zz.
std::vector<std::string> tensor_columns(const std::string& name);

/// Three number columns read as vectors, or zeros where the table lacks them.
class VectorColumn {
public:
    VectorColumn(const Table& table, const std::vector<std::string>& columns);
    Vec3 operator[](std::size_t row) const;

private:
    std::vector<const std::vector<double>*> columns_;
};

}  // namespace jostle
