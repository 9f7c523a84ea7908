#pragma once

#include "jostle/scene/scene.hpp"

namespace jostle {

/// Throws InputError where a schedule of the box does not go with what else the scene has.
void validate_schedule(const Scene& scene);

/// Throws InputError if a schedule makes the box so small that the rods cannot be packed. Of rods that the scene gives.
void validate_packing_of_schedule(const Scene& scene);

}  // namespace jostle
