#pragma once

#include <string_view>

#include "jostle/scene_file/toml_document.hpp"

namespace jostle {

/// A table that a scene may have beside those with keys: what `jostle sweep` runs the scene with.
inline constexpr std::string_view sweep_table = "sweep";

/// Whether a scene has this key, as "box.volume_fraction".
bool is_scene_key(std::string_view full_key);

/// Refuses keys and tables that no scene has, with the place, all that are allowed there and the nearest of them.
/// Errors: InputError.
void refuse_unknown_keys(const TomlDocument& document);

bool has_unknown_keys(const TomlDocument& document);

/// The same of one full key, which the command line sets to `value`.
void refuse_unknown_key(std::string_view full_key, const std::string& value, const Place& place);

}  // namespace jostle
