#pragma once

#include <optional>
#include <vector>

#include "jostle/contact/previous_force.hpp"
#include "jostle/rods/box.hpp"
#include "jostle/rods/clock.hpp"
#include "jostle/rods/rods.hpp"
#include "jostle/rods/spring.hpp"

namespace jostle {

/// All that the next step depends on, beside the scene: a checkpoint is this and the scene.
struct State {
    Box box;
    Rods rods;
    Clock clock = {};
    std::vector<Spring> springs = {};  ///< between the rods, by ids
    std::vector<PreviousForce> previous_forces =
        {};                              ///< by ids; empty unless steps begin from those of the step before
    std::optional<Vec3> box_force = {};  ///< of the last step, `force_on_box`; none where no bath changes the box
};

/// In the order of (i, j, feature, upper, gamma).
void sort_by_ids(std::vector<PreviousForce>& forces);

/// The same state, its rods in the order of ids, its forces sorted by ids.
State in_order_of_ids(const State& state);

}  // namespace jostle
