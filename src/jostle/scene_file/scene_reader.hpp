#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "jostle/error/input_error.hpp"
#include "jostle/scene/scene.hpp"

namespace jostle {

/// Reads and validates a scene file.
///
/// Throws InputError with the place, the value as written, what is allowed and a suggestion, for a file that is
/// missing, unreadable, empty, cut short or not TOML, and for everything that `parse_scene` refuses.
Scene read_scene(const std::filesystem::path& path);

/// The text of a scene file; a pipe will do. Errors: InputError if it is missing, unreadable or too large for a scene.
std::string read_scene_text(const std::filesystem::path& path);

/// The same error with the line and column of its key in the scene file, and the value as it is written there, as far
/// as they can be told: the name of the file alone if the key is none of a scene or the file cannot be read again.
InputError in_scene_file(const std::filesystem::path& path, const InputError& error);

/// Reads and validates a scene in TOML; `file_name` is for messages.
///
/// Keys are those of `for_each_key`. In the micro system numbers may carry units (`parse_quantity`), and the viscosity,
/// kT and the diameter must be given: 1 is a natural default in reduced units only. A table [sweep] is for `jostle
/// sweep`, and not looked at.
/// Throws InputError for unknown, missing, repeated and unused keys, wrong types and whatever `validate` refuses: for
/// all keys that are wrong by themselves, and all that do not go together in tables without such a key, at once.
Scene parse_scene(std::string_view text, std::string file_name);

/// Whether a scene has a table [sweep].
bool has_sweep(std::string_view text);

}  // namespace jostle
