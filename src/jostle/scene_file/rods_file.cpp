#include "jostle/scene_file/rods_file.hpp"

#include <fmt/format.h>

#include <array>

#include "jostle/disk/durable_file.hpp"
#include "jostle/scene/scene_keys.hpp"
#include "jostle/tables/csv_rows.hpp"

namespace jostle {

namespace {

constexpr std::array<std::string_view, 9> rod_names = {"x", "y", "nx", "ny", "z", "nz", "length", "diameter", "speed"};
constexpr CsvColumns rod_columns = {rod_names, 6, "a rods file",
                                    "The header names the columns x,y,z,nx,ny,nz and optionally length,diameter,speed"};
constexpr CsvColumns columns_in_plane = {
    rod_names, 4, "a rods file in the plane",
    "The header names the columns x,y,nx,ny and optionally length,diameter,speed (and z,nz, which are 0)"};

/// The value of a column along z; in two dimensions 0, and nothing else. (A -0 of the file is 0, too.)
double along_z(std::string_view name, const std::optional<double>& value, bool flat, const std::string& path,
               int line) {
    if (!flat) return *value;
    if (value.value_or(0.0) == 0.0) return 0.0;
    throw refused_file(path, fmt::format("{} = {} lies out of the plane of box.dimensions = 2", name, *value),
                       fmt::format("Leave out {}, or set it to 0", name), line);
}

}  // namespace

Rods read_rods(const std::string& path, double default_length, double default_diameter, int dimensions) {
    Rods rods;
    const bool flat = dimensions == 2;
    const CsvColumns& columns = flat ? columns_in_plane : rod_columns;
    for_each_csv_row(path, columns, [&](int line, std::span<const std::optional<double>> values) {
        const Vec3 centre{*values[0], *values[1], along_z("z", values[4], flat, path, line)};
        const Vec3 axis{*values[2], *values[3], along_z("nz", values[5], flat, path, line)};
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
