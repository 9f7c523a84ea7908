#pragma once

#include <vector>

#include "jostle/motion/step_limit.hpp"
#include "jostle/rods/rods.hpp"
#include "jostle/scene/scene.hpp"

// What of a scene keeps its rods at a pressure: its table [pressure].

namespace jostle {

/// Whether a bath compresses rods without thermal motion.
bool compresses(const Scene& scene);

bool is_piston(const Scene& scene);

/// The direction whose upper plane is the piston, 0 to 2.
int piston_direction(const Scene& scene);

/// pressure.relaxation_time of `count` rods. "auto": that in which a rod of mean size alone diffuses its length and
/// diameter; of a piston that which makes it a tenth as mobile as a rod; without thermal motion 100 viscosities over
/// the pressure. `edge`: of the box across the piston, at the start.
double pressure_relaxation_time(const Scene& scene, double count, double edge);

/// How far the box, or the piston, brings rods that touch nearer in a step: by its noise and by the bath, or without
/// thermal motion where nothing resists. `rods`: all, or one that stands for all.
std::vector<StepLimit> pressure_limits(const Scene& scene, const Rods& rods);

/// How far forces may move the box in a step: so that rods that touch come nearer by as much as `jostle check` advises.
/// Of the logarithm of the volume, or of each edge. Not of a piston, which forces move in the step in which they act.
double largest_box_move(const Scene& scene, const Rods& rods);

/// Throws InputError where a bath of pressure does not go with what else the scene has.
void validate_pressure(const Scene& scene);

}  // namespace jostle
