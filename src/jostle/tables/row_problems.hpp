#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace jostle {

/// What is wrong with the rows of a table, told together: every row by file and line, up to a limit.
class RowProblems {
public:
    explicit RowProblems(const std::string& path);

    /// Adds a problem, a clause without a full stop, of a row counted from 0.
    void add(std::size_t row, std::string_view problem);

    /// Whether a row has any.
    bool has(std::size_t row) const { return of_row_.contains(row); }

    /// The row as messages name it: "line 7", or "row 7" of a file without lines, counted from 1.
    std::string name_of(std::size_t row) const;

    /// Throws one InputError with a line for every problem, the first twenty, and how many more there are.
    void throw_if_any() const;

    std::vector<int> line;  ///< (rows) of the file; empty where it has none

private:
    std::string path_;
    std::map<std::size_t, std::vector<std::string>> of_row_;
};

}  // namespace jostle
