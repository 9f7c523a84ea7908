#include "jostle/scene_file/scene_reader.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "jostle/disk/durable_file.hpp"
#include "jostle/error/nearest_word.hpp"
#include "jostle/scene/mistakes.hpp"
#include "jostle/scene/pressure_control.hpp"
#include "jostle/scene/scene_keys.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/scene_ranges.hpp"
#include "jostle/scene/unused_keys.hpp"
#include "jostle/scene/validate_scene.hpp"
#include "jostle/scene_file/key_reader.hpp"
#include "jostle/scene_file/toml_document.hpp"
#include "jostle/scene_file/unknown_keys.hpp"

namespace jostle {

namespace {

void read_keys(const TomlDocument& document, Scene& scene, Mistakes& mistakes) {
    for_each_key(scene, [&](std::string_view table, std::string_view name, auto& member, const auto& spec) {
        if (const toml::node* node = document.find(table, name))
            mistakes.look([&] {
                KeyReader(document, scene.units.system, dimensions_of(scene), full_key(table, name))
                    .read(*node, member, spec);
            });
    });
    leave_out_z(scene);
}

/// A key that has no default, and a value to begin with.
struct RequiredKey {
    std::string table, name, example;
};

/// Whether a mistake is about this key, as "lenght" is about "length" and rods = 5 about all of its table.
bool is_explained(const Mistakes& mistakes, const std::string& table, const std::string& name) {
    return std::any_of(mistakes.found().begin(), mistakes.found().end(), [&](const InputError& error) {
        const InputError::Parts& parts = error.parts();
        return parts.key == table || parts.suggestion.find("\"" + name + "\"") != std::string::npos ||
               parts.suggestion.find("\"" + table + "\"") != std::string::npos;
    });
}

/// Keys that the scene needs, lacks, and that no mistake so far is about.
Mistakes find_missing(const TomlDocument& document, const Scene& scene, const Mistakes& mistakes) {
    Mistakes missing;
    std::vector<RequiredKey> required;
    if (!rods_are_given(scene)) required.push_back({"rods", "count", "2000"});
    required.push_back({"rods", "length", "5.0"});
    required.push_back({"time", "production", "50.0"});
    if (scene.units.system == UnitSystem::micro) {
        required.push_back({"rods", "diameter", "\"1 um\""});
        required.push_back({"fluid", "viscosity", "\"1e-3 Pa s\""});
        required.push_back({"fluid", "kT", "\"0.00411 pN um\""});
    }
    if (grows(scene))
        required.push_back(
            {"growth", "division_length", fmt::format("{:.6g}", 2.0 * scene.rods.length + scene.rods.diameter)});
    for (const auto& [table, name, example] : required)
        if (!document.find(table, name) && !is_explained(mistakes, table, name))
            missing.add(InputError({table + "." + name, "", "is missing", "",
                                    fmt::format("Add {} = {} under [{}]", name, example, table),
                                    document.place_of(table + "." + name)}));
    return missing;
}

void find_unused(const TomlDocument& document, const Scene& scene, Mistakes& mistakes) {
    for (const auto& [key, reason, suggestion] : unused_keys(scene)) {
        const std::size_t dot = key.find('.');
        const toml::node* node = document.find(key.substr(0, dot), key.substr(dot + 1));
        if (node)
            mistakes.add(InputError(
                {key, document.written(node->source()), reason, "", suggestion, document.place(node->source())}));
    }
}

void place_key(const TomlDocument& document, InputError::Parts& parts) {
    const auto [table, name] = parts_of_key(parts.key);
    if (const toml::node* node = document.find(table, name)) parts.value = document.written(node->source());
    parts.place = document.place_of(parts.key);
}

/// The error with the place of its key and its value as the user wrote it; the others, too.
InputError with_place(const TomlDocument& document, const InputError& error) {
    InputError::Parts parts = error.parts();
    place_key(document, parts);
    for (InputError::Parts& other : parts.others) place_key(document, other);
    return InputError(parts);
}

/// Mistakes of keys that are there, each by itself.
void find_out_of_range(const TomlDocument& document, const Scene& scene, Mistakes& mistakes) {
    Mistakes found;
    found.look([&] { require_ranges(scene); });
    for (const InputError& error : found.found()) {
        const std::string& key = error.parts().key;
        const auto [table, name] = parts_of_key(key);
        const bool known = std::any_of(mistakes.found().begin(), mistakes.found().end(),
                                       [&](const InputError& other) { return other.parts().key == key; });
        if (!known && document.find(table, name)) mistakes.add(with_place(document, error));
    }
}

/// What does not go together, or lacks one of several keys, of tables without a mistake; nothing where a mistake is of
/// no table: what it stands for is not known.
void find_misfits(const TomlDocument& document, const Scene& scene, Mistakes& missing, Mistakes& mistakes) {
    std::vector<std::string> unsound;
    for (const Mistakes* found : {&std::as_const(mistakes), &std::as_const(missing)})
        for (const InputError& error : found->found()) unsound.emplace_back(parts_of_key(error.parts().key).first);
    const bool known = std::none_of(unsound.begin(), unsound.end(),
                                    [](const std::string& table) { return table.empty() || table == "units"; });
    if (!known || unsound.empty()) return;
    Mistakes misfits;
    misfits.look([&] { require_fit_together(scene, unsound); });
    for (const InputError& error : misfits.found()) {
        const auto [table, name] = parts_of_key(error.parts().key);
        if (is_explained(mistakes, std::string(table), std::string(name))) continue;
        (document.find(table, name) ? mistakes : missing).add(with_place(document, error));
    }
}

[[noreturn]] void refuse_file(const std::filesystem::path& path, std::string problem, std::string suggestion) {
    throw InputError({"scene", "", std::move(problem), "a TOML file", std::move(suggestion), {path.string(), 0, 0}});
}

/// A file in the folder of `path` with nearly its name.
std::string suggestion_for_missing(const std::filesystem::path& path) {
    std::vector<std::string> names;
    std::error_code error;
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
        names.push_back(entry->path().filename().string());
    std::sort(names.begin(), names.end());  // the order of a folder is arbitrary
    const std::string near = did_you_mean(path.filename().string(), names);
    return near.empty() ? "Check the name and the folder" : near;
}

}  // namespace

Scene read_scene(const std::filesystem::path& path) {
    return parse_scene(read_scene_text(path), path.string());
}

std::string read_scene_text(const std::filesystem::path& path) {
    constexpr std::size_t largest = 1 << 20;
    std::error_code error;
    if (std::filesystem::is_directory(path, error))
        refuse_file(path, "is a directory", "Give the scene file, as " + (path / "scene.toml").string());
    if (!std::filesystem::exists(path, error)) refuse_file(path, "there is no such file", suggestion_for_missing(path));
    std::string text, block;
    try {
        ReadFile file(path.string());
        for (file.read_up_to(largest, block); !block.empty() && text.size() <= largest; file.read_up_to(4096, block))
            text += block;
    } catch (const DiskError& failure) {
        refuse_file(path, fmt::format("cannot be read: {}", std::strerror(failure.error_number())),
                    "Check who may read it, and the disk");
    } catch (const InputError& refusal) {
        refuse_file(path, refusal.parts().problem, refusal.parts().suggestion);
    }
    if (text.size() > largest)
        refuse_file(path, "is larger than 1 MiB, too large for a scene", "Give the scene, not an output of a run");
    return text;
}

InputError in_scene_file(const std::filesystem::path& path, const InputError& error) {
    if (!is_scene_key(error.parts().key)) return error.with_place({path.string()});
    try {
        return with_place(TomlDocument(read_scene_text(path), path.string()), error);
    } catch (const InputError&) {  // what was read is not there any more, as of a pipe
        return error.with_place({path.string()});
    }
}

Scene parse_scene(std::string_view text, std::string file_name) {
    const TomlDocument document(text, file_name);
    if (document.root().empty())
        throw InputError({"scene",
                          "",
                          "is empty: there is no key in it",
                          "",
                          "Begin with the scene in the README",
                          {file_name, 1, 1}});
    Mistakes mistakes;
    mistakes.look([&] { refuse_unknown_keys(document); });
    Scene scene;
    read_keys(document, scene, mistakes);
    const bool read = mistakes.empty();
    Mistakes missing = find_missing(document, scene, mistakes);
    if (read) find_unused(document, scene, mistakes);
    find_out_of_range(document, scene, mistakes);
    find_misfits(document, scene, missing, mistakes);
    mistakes.sort_by_place();
    for (const InputError& error : missing.found()) mistakes.add(error);
    mistakes.refuse_any();
    try {
        validate(scene);
    } catch (const InputError& error) {
        Mistakes placed;
        placed.add(with_place(document, error));
        placed.sort_by_place();
        placed.refuse_any();
    }
    // A growing population has no equilibrium to wait for.
    const bool settles = !grows(scene) && !compresses(scene);
    if (!settles && !scene.time.equilibration) scene.time.equilibration = 0.0;
    return scene;
}

bool has_sweep(std::string_view text) {
    return TomlDocument(text, "").root().contains(sweep_table);
}

}  // namespace jostle
