#pragma once

#include <optional>
#include <string>
#include <vector>

#include "jostle/rods/box.hpp"
#include "jostle/stress/contact_stress.hpp"
#include "jostle/tables/body_table.hpp"

namespace jostle {

/// Contacts between the bodies of a table, as another program lists them.
struct ContactTable {
    std::vector<BodyContact> contacts;  ///< bodies are rows of the table of bodies
    bool one_point = false;             ///< both bodies are touched at the same place
    TableUnits units;
    std::vector<std::string> passed_over;  ///< columns that nothing was read from
};

/// Reads contacts from a table (`read_table`).
///
/// Columns: body_1, body_2 (ids); force_x, force_y, force_z on body 2; where the force acts, as one of
///   contact_x, contact_y, contact_z              one place for both, in the coordinates of the bodies' centres
///   point_1_x, _y, _z and point_2_x, _y, _z      a place on each, relative to its centre
/// and where the centres are more than the bodies' table says, one of
///   separation_x, separation_y, separation_z     r_2 - r_1
///   image_x, image_y, image_z                    box edges by which body 2 is displaced, whole numbers; needs `box`
/// Without these two, along the periodic directions of `box` the nearest images meet: that of each body nearest to
/// contact_x ..., else those of the two centres that are nearest to each other. A distance of half an edge is refused.
/// Errors: InputError for missing columns, and one with a line for each row that cannot be taken; DiskError.
ContactTable read_contacts(const std::string& path, const BodyTable& bodies, const std::optional<Box>& box);

}  // namespace jostle
