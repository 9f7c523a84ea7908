#pragma once

#include <span>

#include "jostle/motion/springs.hpp"
#include "jostle/rods/box.hpp"
#include "jostle/rods/rods.hpp"
#include "jostle/scene/scene.hpp"

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

/// Throws InputError (box.edges) where a step turns a rod by more, in the root mean square per axis, than its own
/// periodic images let it be inclined to either side: it could not be told what holds it.
void require_room_between_images(const Scene& scene, const Box& box, const MobilityOperator& mobility, const Rods& rods,
                                 double time_step);

/// Of contact.model = "wca": over the overlap of two rods that meet with 5 kT (one encounter in 150), how far apart
/// their force throws them in a step, at most: dt U'' 2 m (theory, eq. 2.20), with m the larger mobility of a rod's
/// end. Above 2 they come to lie farther apart than they overlapped, and throw others.
double potential_relaxation(const Scene& scene, const MobilityOperator& mobility, const Rods& rods, double time_step);

/// Throws InputError (contact.energy) where that is above 2. Nothing where rods are hard.
void require_soft_potential(const Scene& scene, const MobilityOperator& mobility, const Rods& rods, double time_step);

}  // namespace jostle
