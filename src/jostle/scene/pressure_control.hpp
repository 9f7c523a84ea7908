#pragma once

#include "jostle/motion/step_limit.hpp"
#include "jostle/rods/rods.hpp"
#include "jostle/scene/scene.hpp"

// What of a scene keeps its rods at a pressure: its table [pressure].

namespace jostle {

/// pressure.relaxation_time; "auto": that in which a rod of mean size alone diffuses its length and diameter.
double pressure_relaxation_time(const Scene& scene);

/// How far the noise of the box brings rods that touch nearer in a step. `rods`: all, or one that stands for all.
StepLimit pressure_limit(const Scene& scene, const Rods& rods);

/// Throws InputError where a bath of pressure does not go with what else the scene has.
void validate_pressure(const Scene& scene);

}  // namespace jostle
