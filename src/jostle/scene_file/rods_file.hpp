#pragma once

#include <string>

#include "jostle/rods/rods.hpp"

namespace jostle {

/// Reads rods from a CSV file for start = "file".
///
/// A header line, then one rod a line. Columns in any order: x, y, z (centre), nx, ny, nz (axis, of any length but 0),
/// and optionally length and diameter, else `default_length` and `default_diameter`, and speed (of self-propulsion).
/// In two dimensions z and nz may be left out, and are 0. Ids are 0, 1, 2, ... in the order of the lines. Errors:
/// InputError with line and column for anything missing, unknown or not a finite number; DiskError.
Rods read_rods(const std::string& path, double default_length, double default_diameter, int dimensions = 3);

}  // namespace jostle
