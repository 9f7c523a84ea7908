#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "jostle/motion/motion.hpp"
#include "jostle/rods/clock.hpp"

namespace jostle {

/// What a schedule sets in one step.
struct Conditions {
    double kT = 0.0;                               ///< of the Brownian motion, mean over the step
    std::vector<std::unique_ptr<Motion>> motions;  ///< in the place of those that the simulation was made with
    std::optional<Vec3> edges;                     ///< of the box at the end of the step; none: it stays
};

/// The conditions of the step that the clock stands before: a function of the time alone, so that a run that goes on
/// makes the same steps. Empty: nothing changes but by the rods.
using Schedule = std::function<Conditions(const Clock&)>;

}  // namespace jostle
