#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "jostle/rods/spring.hpp"

namespace jostle {

/// Reads springs from a CSV file for `springs.file`.
///
/// A header line, then one spring a line. Columns in any order: rod_1, rod_2 (ids, below `rod_count`), s_1, s_2
/// (positions along the axes, from the centres; |s| <= half of `length_of(id)`), rest_length and stiffness (both >= 0).
/// All images are 0. Errors: InputError with line and column for anything missing, unknown, not a finite number or out
/// of its range; DiskError.
std::vector<Spring> read_springs(const std::string& path, std::uint64_t rod_count,
                                 const std::function<double(std::uint64_t id)>& length_of);

}  // namespace jostle
