#pragma once

#include <string>

#include "jostle/run_files/checkpoint.hpp"
#include "jostle/scene/scene.hpp"

namespace jostle {

/// The scene of the run that wrote a checkpoint into `folder`. Errors: InputError if this version cannot read it.
Scene scene_of(const Checkpoint& checkpoint, const std::string& folder);

/// Refuses a checkpoint of a scene of other physics, key by key; the message names the first. Keys that only tell when
/// to end, or what is written and when, may be others (scene_keys.hpp, `may_change`). Errors: InputError.
void require_same_scene(const Checkpoint& checkpoint, const Scene& scene, const std::string& folder);

}  // namespace jostle
