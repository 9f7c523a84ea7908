#pragma once

#include "jostle/scene/scene.hpp"

namespace jostle {

/// Throws InputError for all keys, of those that mean something in this scene, whose value is outside the range of
/// scene_keys.hpp.
void require_ranges(const Scene& scene);

}  // namespace jostle
