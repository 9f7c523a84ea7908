#include "jostle/scene_file/rods_file.hpp"

#include <fmt/format.h>

#include <array>

#include "jostle/disk/durable_file.hpp"
#include "jostle/scene/scene_keys.hpp"
#include "jostle/tables/csv_rows.hpp"

namespace jostle {

namespace {

constexpr std::array<std::string_view, 9> rod_names = {"x", "y", "z", "nx", "ny", "nz", "length", "diameter", "speed"};
constexpr CsvColumns rod_columns = {rod_names, 6, "a rods file",
                                    "The header names the columns x,y,z,nx,ny,nz and optionally length,diameter,speed"};

}  // namespace

Rods read_rods(const std::string& path, double default_length, double default_diameter) {
    Rods rods;
    for_each_csv_row(path, rod_columns, [&](int line, std::span<const std::optional<double>> values) {
        const Vec3 centre{*values[0], *values[1], *values[2]}, axis{*values[3], *values[4], *values[5]};
        const double length = values[6].value_or(default_length), diameter = values[7].value_or(default_diameter);
        if (!(norm(axis) > 1e-12)) throw refused_file(path, "the axis (nx, ny, nz) has no direction", "", line);
        if (length < 0.0) throw refused_file(path, fmt::format("length = {} is negative", length), "", line);
        if (!(diameter > 0.0))
            throw refused_file(path, fmt::format("diameter = {} is not positive", diameter), "", line);
        if (length > Range::largest_length)
            throw refused_file(path, fmt::format("length = {} is above {}", length, Range::largest_length), "", line);
        if (!positive_length.contains(diameter))
            throw refused_file(path,
                               fmt::format("diameter = {} is outside of {} to {}", diameter, Range::smallest_length,
                                           Range::largest_length),
                               "", line);
        rods.push_back(rods.size(), centre, normalised(axis), length, diameter);
        if (values[8]) rods.speed.push_back(*values[8]);
    });
    if (rods.size() == 0) throw refused_file(path, "the file holds no rods", "");
    return rods;
}

}  // namespace jostle
