#include "jostle/io/scene_reader.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <utility>
#include <vector>

#include "jostle/io/durable_file.hpp"
#include "jostle/io/key_reader.hpp"
#include "jostle/io/nearest_word.hpp"
#include "jostle/io/toml_document.hpp"
#include "jostle/simulation/scene_keys.hpp"
#include "jostle/simulation/unused_keys.hpp"
#include "jostle/simulation/validate_scene.hpp"

namespace jostle {

namespace {

using KeysOfTables = std::map<std::string, std::vector<std::string>, std::less<>>;

KeysOfTables keys_of_tables() {
    KeysOfTables keys;
    const Scene scene;
    for_each_key(scene, [&](std::string_view table, std::string_view name, const auto&, const auto&) {
        keys[std::string(table)].emplace_back(name);
    });
    return keys;
}

/// What to do about a key that no table, or another one, has.
std::string suggestion_for(std::string_view name, const std::string& table, const KeysOfTables& known) {
    for (const auto& [other, names] : known)
        if (other != table && std::find(names.begin(), names.end(), name) != names.end())
            return fmt::format("The key \"{}\" belongs {}", name,
                               other.empty() ? "at the top, above all tables" : "to [" + other + "]");
    std::vector<std::string> candidates = known.at(table);
    if (table.empty())
        for (const auto& [other, names] : known) candidates.push_back(other);
    return did_you_mean(name, candidates);
}

void refuse_unknown(const TomlDocument& document, const toml::table& table, const std::string& table_name,
                    const KeysOfTables& known) {
    const std::vector<std::string>& names = known.at(table_name);
    for (const auto& [key, value] : table) {
        const std::string name(key.str());
        const bool is_table = table_name.empty() && !name.empty() && known.contains(name);
        if (is_table && !value.is_table())
            throw InputError({name, document.written(value.source()),
                              "is " + type_name(value) + ", and must be a table", "[" + name + "]",
                              fmt::format("Write [{}] and below it the keys {}", name, quoted_list(known.at(name))),
                              document.place(value.source())});
        if (is_table) refuse_unknown(document, *value.as_table(), name, known);
        if (is_table || std::find(names.begin(), names.end(), name) != names.end()) continue;
        std::vector<std::string> allowed = names;
        if (table_name.empty())
            for (const auto& [other, other_names] : known)
                if (!other.empty()) allowed.push_back("[" + other + "]");
        const bool heading = value.is_table();
        throw InputError({full_key(table_name, document.written(key.source())),
                          heading ? "" : document.written(value.source()),
                          heading ? "is an unknown table" : "is an unknown key", quoted_list(allowed),
                          suggestion_for(name, table_name, known), document.place(key.source())});
    }
}

void read_keys(const TomlDocument& document, Scene& scene) {
    for_each_key(scene, [&](std::string_view table, std::string_view name, auto& member, const auto& spec) {
        if (const toml::node* node = document.find(table, name))
            KeyReader(document, scene.units.system, full_key(table, name)).read(*node, member, spec);
    });
    const bool brownian_step = scene.motion.brownian && scene.fluid.kT > 0.0 && scene.growth.rate == 0.0;
    if (!scene.time.step && !scene.time.rms_step && brownian_step) scene.time.rms_step = default_rms_step;
}

/// A key that has no default, and a value to begin with.
struct RequiredKey {
    std::string table, name, example;
};

void refuse_missing(const TomlDocument& document, const Scene& scene) {
    std::vector<RequiredKey> required;
    if (scene.rods.start != StartKind::file) required.push_back({"rods", "count", "2000"});
    required.push_back({"rods", "length", "5.0"});
    required.push_back({"time", "production", "50.0"});
    if (scene.units.system == UnitSystem::micro) {
        required.push_back({"rods", "diameter", "\"1 um\""});
        required.push_back({"fluid", "viscosity", "\"1e-3 Pa s\""});
        required.push_back({"fluid", "kT", "\"0.00411 pN um\""});
    }
    if (scene.growth.rate > 0.0)
        required.push_back(
            {"growth", "division_length", fmt::format("{:.6g}", 2.0 * scene.rods.length + scene.rods.diameter)});
    for (const auto& [table, name, example] : required)
        if (!document.find(table, name))
            throw InputError({table + "." + name, "", "is missing", "",
                              fmt::format("Add {} = {} under [{}]", name, example, table),
                              document.place_of(table + "." + name)});
}

void refuse_unused(const TomlDocument& document, const Scene& scene) {
    for (const auto& [key, reason, suggestion] : unused_keys(scene)) {
        const std::size_t dot = key.find('.');
        const toml::node* node = document.find(key.substr(0, dot), key.substr(dot + 1));
        if (node)
            throw InputError(
                {key, document.written(node->source()), reason, "", suggestion, document.place(node->source())});
    }
}

/// Table and name of a full key; a key at the top has the table "".
std::pair<std::string, std::string> parts_of(const std::string& key) {
    const std::size_t dot = key.find('.');
    if (dot == std::string::npos) return {"", key};
    return {key.substr(0, dot), key.substr(dot + 1)};
}

/// The error with the place of its key and its value as the user wrote it.
InputError with_place(const TomlDocument& document, const InputError& error) {
    InputError::Parts parts = error.parts();
    const auto [table, name] = parts_of(parts.key);
    if (const toml::node* node = document.find(table, name)) parts.value = document.written(node->source());
    parts.place = document.place_of(parts.key);
    return InputError(parts);
}

bool is_key(const std::string& key) {
    const KeysOfTables known = keys_of_tables();
    const auto [table, name] = parts_of(key);
    const auto found = known.find(table);
    return found != known.end() && std::find(found->second.begin(), found->second.end(), name) != found->second.end();
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
    if (!is_key(error.parts().key)) return error.with_place({path.string()});
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
    refuse_unknown(document, document.root(), "", keys_of_tables());
    Scene scene;
    read_keys(document, scene);
    refuse_missing(document, scene);
    refuse_unused(document, scene);
    try {
        validate(scene);
    } catch (const InputError& error) {
        throw with_place(document, error);
    }
    // A growing population has no equilibrium to wait for.
    if (scene.growth.rate > 0.0 && !scene.time.equilibration) scene.time.equilibration = 0.0;
    return scene;
}

}  // namespace jostle
