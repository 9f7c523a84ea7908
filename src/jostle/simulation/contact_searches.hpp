#pragma once

#include <algorithm>

#include "jostle/contact/collision_search.hpp"
#include "jostle/contact/fixed_rod_search.hpp"
#include "jostle/contact/wall_search.hpp"

namespace jostle {

/// The searches for contacts of rods with each other, with walls and with fixed rods.
struct ContactSearches {
    CollisionSearch rods;
    WallSearch walls;
    FixedRodSearch fixed_rods;

    /// The contacts of the step, in place of what `contacts` held. Returns the largest overlap before the known motion,
    /// max(0, -gap).
    double find(const StepGeometry& step, Contacts& contacts) {
        const double of_rods = rods.find(step, contacts);
        const double with_walls = walls.find(step, contacts);
        return std::max({of_rods, with_walls, fixed_rods.find(step, contacts)});
    }
};

}  // namespace jostle
