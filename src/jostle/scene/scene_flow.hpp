#pragma once

#include "jostle/motion/shear_flow.hpp"
#include "jostle/rods/box.hpp"
#include "jostle/scene/scene.hpp"

namespace jostle {

/// Whether the rods of a scene are sheared, or its box is from the start.
bool has_flow(const Scene& scene);

/// Whether something is sheared while time goes on.
bool flows(const Scene& scene);

/// Whether the flow goes to and fro.
bool oscillates(const Scene& scene);

ShearFlow flow_of(const Scene& scene);

/// A box, its copies above displaced as the flow has them when the run begins.
Box sheared_at_start(const Scene& scene, const Box& box);

/// The checks of how [flow] goes with other tables. Errors: InputError.
void validate_flow(const Scene& scene);

/// Whether the box is wide enough for sheared rods, the longest of which measures `longest` from end to end. Errors:
/// InputError.
void validate_sheared_box(const Scene& scene, double rods_volume, double longest);

}  // namespace jostle
