#include "jostle/scene_file/springs_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "jostle/disk/durable_file.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/tables/csv_rows.hpp"

namespace jostle {

namespace {

constexpr std::array<std::string_view, 6> spring_names = {"rod_1", "rod_2", "s_1", "s_2", "rest_length", "stiffness"};
constexpr CsvColumns spring_columns = {spring_names, 6, "a springs file",
                                       "The header names the columns rod_1,rod_2,s_1,s_2,rest_length,stiffness"};
/// |s| may pass half the length by this part of it: ends computed elsewhere miss it by rounding.
constexpr double rounding = 1e-9;

/// One line of the file, whose numbers are looked at one by one.
class Line {
public:
    Line(const std::string& path, int number, std::span<const std::optional<double>> values)
        : path_(path), number_(number), values_(values) {}

    std::uint64_t id(std::size_t column, std::uint64_t rod_count) const {
        const double value = *values_[column];
        if (!(value >= 0.0 && value < static_cast<double>(rod_count) && value == std::floor(value)))
            refuse(column, "is the id of no rod", fmt::format("0 to {}", rod_count - 1));
        return static_cast<std::uint64_t>(value);
    }

    double position(std::size_t column, std::uint64_t rod, double length) const {
        const double value = *values_[column];
        if (!(std::fabs(value) <= 0.5 * length * (1.0 + rounding)))
            refuse(column, fmt::format("lies beyond the end of rod {}, of length {}", rod, length),
                   fmt::format("{} to {}", -0.5 * length, 0.5 * length));
        return value;
    }

    double zero_or_positive(std::size_t column) const {
        const double value = *values_[column];
        if (value < 0.0) refuse(column, "is negative", "at least 0");
        return value;
    }

    [[noreturn]] void refuse(std::size_t column, const std::string& problem, const std::string& allowed) const {
        throw InputError({.key = std::string(spring_names[column]),
                          .value = fmt::format("{}", *values_[column]),
                          .problem = problem,
                          .allowed = allowed,
                          .place = {path_, number_}});
    }

private:
    const std::string& path_;
    int number_;
    std::span<const std::optional<double>> values_;
};

}  // namespace

std::vector<Spring> read_springs(const std::string& path, std::uint64_t rod_count,
                                 const std::function<double(std::uint64_t)>& length_of) {
    std::vector<Spring> springs;
    for_each_csv_row(path, spring_columns, [&](int number, std::span<const std::optional<double>> values) {
        const Line line(path, number, values);
        Spring spring;
        spring.rod_1 = line.id(0, rod_count);
        spring.rod_2 = line.id(1, rod_count);
        if (spring.rod_1 == spring.rod_2) line.refuse(1, "is rod_1, too", "another rod");
        spring.s_1 = line.position(2, spring.rod_1, length_of(spring.rod_1));
        spring.s_2 = line.position(3, spring.rod_2, length_of(spring.rod_2));
        spring.rest_length = line.zero_or_positive(4);
        spring.stiffness = line.zero_or_positive(5);
        springs.push_back(spring);
    });
    if (springs.empty()) throw refused_file(path, "the file holds no springs", "");
    return springs;
}

}  // namespace jostle
