#include "jostle/tables/row_problems.hpp"

#include <fmt/format.h>

#include "jostle/error/input_error.hpp"
#include "jostle/error/one_line.hpp"

namespace jostle {

namespace {
constexpr std::size_t max_told = 20;
constexpr std::size_t longest_problem = 1000;  // bytes
}  // namespace

RowProblems::RowProblems(const std::string& path) : path_(on_one_line(path, longest_file_name)) {}

void RowProblems::add(std::size_t row, std::string_view problem) {
    of_row_[row].push_back(on_one_line(problem, longest_problem));
}

std::string RowProblems::name_of(std::size_t row) const {
    return row < line.size() ? fmt::format("line {}", line[row]) : fmt::format("row {}", row + 1);
}

void RowProblems::throw_if_any() const {
    std::string told;
    std::size_t count = 0;
    for (const auto& [row, problems] : of_row_)
        for (const std::string& problem : problems) {
            if (++count > max_told) continue;
            const std::string place =
                row < line.size() ? fmt::format("{}:{}", path_, line[row]) : fmt::format("{}: row {}", path_, row + 1);
            told += fmt::format("{}{}: {}", told.empty() ? "" : "\n", place, problem);
        }
    if (count > max_told) told += fmt::format("\n{}: {} more problems", path_, count - max_told);
    if (count > 0) throw InputError({.problem = told});
}

}  // namespace jostle
