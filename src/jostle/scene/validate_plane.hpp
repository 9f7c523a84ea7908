#pragma once

#include "jostle/scene/scene.hpp"

namespace jostle {

/// Refuses what a scene of two dimensions asks for and only three have. Errors: InputError.
void validate_plane(const Scene& scene);

}  // namespace jostle
