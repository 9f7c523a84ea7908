#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "jostle/stress/collision_moments.hpp"

namespace jostle {

/// Each rod's part of the collision stress times the volume (theory, eq. 1.15): one half of (r_j - r_i) F of each of
/// its contacts with rods, the whole of those with fixed bodies, and its own geometric stress.
///
/// `ids` (N): ascending. Result (N), in their order; 0 for a rod without contacts. The sum over all rods is
/// `moments.total()` to rounding. What belongs to rods that are not among `ids` is left out.
std::vector<Mat3> stress_per_rod(const CollisionMoments& moments, std::span<const std::uint64_t> ids);

}  // namespace jostle
