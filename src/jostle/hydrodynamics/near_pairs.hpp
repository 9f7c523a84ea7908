#pragma once

#include <cstdint>
#include <span>

#include "jostle/contact/contacts.hpp"

namespace jostle {

/// The pairs of rods of a near field, and how each rod finds its own: entry begin[i] ... begin[i + 1] of `sides` are
/// those of row i, 2 p where it is the first of pair p, 2 p + 1 where it is the second.
struct NearPairs {
    std::span<const PairKey> pairs;
    std::span<const std::size_t> begin;     ///< (N + 1)
    std::span<const std::uint32_t> sides;   ///< (2 pairs)
    std::span<const std::uint32_t> others;  ///< (2 pairs) row of the other rod
};

}  // namespace jostle
