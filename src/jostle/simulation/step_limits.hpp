#pragma once

#include <span>

#include "jostle/motion/springs.hpp"
#include "jostle/rods/rods.hpp"
#include "jostle/simulation/scene.hpp"

// What a time step must not be too long for.

namespace jostle {

/// Throws InputError if cells, but for one in thirty thousand, would lengthen by more than a tenth of `diameter`, that
/// of the thinnest, in a step; or between two looks at who divides (growth.division_every) by more than a quarter of
/// what they add from birth to division.
void require_short_growth(const Scene& scene, double diameter, double time_step);

/// Throws InputError if the production is shorter than a step, or a time of the scene takes more steps than a double
/// can count.
void require_countable_steps(const Scene& scene, double time_step);

/// Throws InputError where rods swim or tumble too fast for the time step: they, or the ends of one, or of a cell as
/// long as it gets, could pass through others. Of daughters that are yet to come all but one in thirty thousand count.
void require_slow_swimmers(const Scene& scene, const Rods& rods, double time_step);

/// Throws InputError (springs.file) if springs would lose more than all of their stretch in a step. Returns the part
/// that they lose, `spring_relaxation`.
double require_slow_springs(const Scene& scene, std::span<const Spring> springs, const MobilityOfRod& mobility_of,
                            double time_step);

}  // namespace jostle
