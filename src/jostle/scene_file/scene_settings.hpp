#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "jostle/error/input_error.hpp"

namespace jostle {

/// KEY=VALUE of the command line: a key of the scene, as "box.volume_fraction", and its value in TOML.
struct Setting {
    std::string key;
    std::string value;
};

/// Reads KEY=VALUE. What is no value of TOML is taken as a text, so that quotes may be left out: rods.start=aligned.
/// Errors: InputError for a text of another form, an unknown key and a key that is set twice.
std::vector<Setting> parse_settings(const std::vector<std::string>& texts);

/// A scene file with these keys set: their values replaced where they stand, else added below the heading of their
/// table. Of two keys that exclude each other, as box.volume_fraction and box.edges, the one that is set takes the
/// place of the other. All else stays as it is written. `file_name` is for messages. Errors: InputError for what is
/// wrong with the file.
std::string with_settings(std::string_view scene, const std::string& file_name, const std::vector<Setting>& settings);

/// The error about a scene with settings: one about a key that was set names --set in the place of the file, one about
/// another key the place where that stands in the file.
InputError in_settings(const std::filesystem::path& scene_path, const std::vector<Setting>& settings,
                       const InputError& error);

/// What `call()` returns; an InputError of it is told so.
template <class Call>
auto in_settings(const std::filesystem::path& scene_path, const std::vector<Setting>& settings, Call&& call) {
    try {
        return call();
    } catch (const InputError& error) {
        throw in_settings(scene_path, settings, error);
    }
}

}  // namespace jostle
