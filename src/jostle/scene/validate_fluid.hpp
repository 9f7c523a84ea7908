#pragma once

#include "jostle/scene/scene.hpp"

namespace jostle {

/// Throws InputError for what is not known with mobility.model = "hydrodynamic".
void validate_fluid(const Scene& scene);

}  // namespace jostle
