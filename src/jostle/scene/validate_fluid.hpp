#pragma once

#include "jostle/rods/rods.hpp"
#include "jostle/scene/scene.hpp"

namespace jostle {

/// Throws InputError for what is not known with mobility.model = "hydrodynamic".
void validate_fluid(const Scene& scene);

/// Throws InputError for rods of a file or a run that swim, and are spheres.
void validate_swimmers_in_fluid(const Scene& scene, const Rods& rods);

}  // namespace jostle
