#pragma once

#include <limits>
#include <span>

#include "jostle/math/mat3.hpp"
#include "jostle/parallel/ranks.hpp"
#include "jostle/rods/spring.hpp"

namespace jostle {

/// Sum over springs of the pair stress, V Sigma_spr (theory, eq. 1.16): (r_2 - r_1) F, and the geometric stress of both
/// rods under F at s.
///
/// `pulls`: forces as the step begins. `centre`, `axis` (N): where the rods stand when the moments of these forces are
/// taken: half way through what springs and contacts do in the step (eq. 1.17). Of the separation of the
/// two points only the part along F counts, so that the stress stays symmetric; its trace is that of all of it. Pulling
/// springs give a negative trace. Of several ranks each adds up the springs whose first rod is one of its `own` first
/// rows.
Mat3 sum_of_spring_stresses(std::span<const Spring> springs, std::span<const SpringPull> pulls, const Rods& rods,
                            std::span<const Vec3> centre, std::span<const Vec3> axis, const Ranks& ranks = {},
                            std::size_t own = std::numeric_limits<std::size_t>::max());

}  // namespace jostle
