#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "jostle/rods/box.hpp"

namespace jostle {

/// Rows of the rods in the order in which a space-filling curve (Morton's) passes their centres: rods near each other
/// in space come near each other in memory. The same for the same centres and ids, whatever the order of rows before.
std::vector<std::uint32_t> space_filling_order(const Rods& rods, const Box& box);

/// Rows of the rods in the order of ids.
std::vector<std::uint32_t> id_order(const Rods& rods);

/// Where each row goes: new_rows(order)[order[k]] == k.
std::vector<std::uint32_t> new_rows(std::span<const std::uint32_t> order);

/// The rods with row k taken from row order[k].
Rods reordered(const Rods& rods, std::span<const std::uint32_t> order);

/// The rods in the order of ids.
Rods in_order_of_ids(const Rods& rods);

}  // namespace jostle
