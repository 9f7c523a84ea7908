#pragma once

#include <string>

#include "jostle/scene/scene.hpp"

namespace jostle {

/// A scene as TOML, with every key that means something in it, numbers to the last bit and their units as comments.
///
/// `parse_scene(to_toml(scene), ...) == scene` for every scene that `validate` accepts.
std::string to_toml(const Scene& scene);

}  // namespace jostle
