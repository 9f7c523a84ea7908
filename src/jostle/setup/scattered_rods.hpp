#pragma once

#include <optional>

#include "jostle/parallel/ranks.hpp"
#include "jostle/rods/box.hpp"
#include "jostle/rods/rods.hpp"
#include "jostle/scene/scene.hpp"

namespace jostle {

/// Rods at random places, those that overlap one that was placed before drawn anew, with random axes or a common one
/// (unit vector): while they are dilute this leaves them as in equilibrium to first order in the density, where pushing
/// them apart would leave too many touching (docs/decisions/0012-random-start.md). Where they are not, overlaps remain.
/// In the order of ids. Ranks call it together: each looks for the overlaps of a part, and all have all rods.
Rods scattered_rods(const Scene& scene, const Box& box, const std::optional<Vec3>& common_axis,
                    const Ranks& ranks = {});

}  // namespace jostle
