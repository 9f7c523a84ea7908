#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "jostle/stress/rigid_body_stress.hpp"
#include "jostle/tables/table.hpp"

namespace jostle {

/// Rigid bodies by id, as another program lists them.
struct BodyTable {
    std::vector<std::int64_t> id;   ///< (bodies), each once
    std::vector<RigidBody> bodies;  ///< (bodies)
    std::unordered_map<std::int64_t, std::uint32_t> row_of;
    TableUnits units;
    std::vector<std::string> passed_over;  ///< columns that nothing was read from
};

/// Reads bodies from a table (`read_table`).
///
/// Columns: id, a whole number; x, y, z, the centre of mass; and one of
///   second_moment_xx, _xy, _xz, _yy, _yz, _zz    N about the centre of mass
///   inertia_xx, ... _zz                          G = tr(N) I - N, the same
///   shape, with what the shape needs, uniform density:
///     sphere          diameter
///     spherocylinder  length (of the cylinder), diameter, axis_x, axis_y, axis_z (of any length but 0)
///     box             edge_x, edge_y, edge_z
///     ellipsoid       semi_axis_x, semi_axis_y, semi_axis_z
///   and, for those with an orientation, quaternion_w, _x, _y, _z (of any length but 0), which turns the box and the
///   ellipsoid, and a spherocylinder along z where its axis is not given; without it they are not turned.
/// Errors: InputError for missing columns, and one with a line for each row that cannot be taken; DiskError.
BodyTable read_bodies(const std::string& path);

}  // namespace jostle
