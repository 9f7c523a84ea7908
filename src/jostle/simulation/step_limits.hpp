#pragma once

#include "jostle/rods/rods.hpp"
#include "jostle/simulation/scene.hpp"

// What a time step must not be too long for.

namespace jostle {

/// Throws InputError if cells would lengthen by more than a tenth of their diameter in a step.
void require_short_growth(const Scene& scene, double time_step);

/// Throws InputError where rods swim or tumble too fast for the time step: they, or the ends of one, or of a cell as
/// long as it gets, could pass through others.
void require_slow_swimmers(const Scene& scene, const Rods& rods, double time_step);

/// Throws InputError (springs.file) if springs would lose more than all of their stretch in a step, by
/// `spring_relaxation`.
void require_slow_springs(const Scene& scene, double relaxation, double time_step);

}  // namespace jostle
