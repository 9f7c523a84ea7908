#include "jostle/scene_file/unknown_keys.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "jostle/error/nearest_word.hpp"
#include "jostle/scene/scene_keys.hpp"
#include "jostle/scene_file/key_reader.hpp"

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

bool has(const std::vector<std::string>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// A table that has the key, or null.
const std::string* table_with(std::string_view name, std::string_view but, const KeysOfTables& known) {
    for (const auto& [table, names] : known)
        if (table != but && has(names, name)) return &table;
    return nullptr;
}

std::string nearest_key(std::string_view name, const std::string& table, const KeysOfTables& known) {
    std::vector<std::string> candidates = known.at(table);
    if (table.empty())
        for (const auto& [other, names] : known) candidates.push_back(other);
    return did_you_mean(name, candidates);
}

/// What to do about a key that no table, or another one, has.
std::string suggestion_for(std::string_view name, const std::string& table, const KeysOfTables& known) {
    const std::string* other = table_with(name, table, known);
    if (!other) return nearest_key(name, table, known);
    return fmt::format("The key \"{}\" belongs {}", name,
                       other->empty() ? "at the top, above all tables" : "to [" + *other + "]");
}

std::string allowed_in(const std::string& table, const KeysOfTables& known) {
    std::vector<std::string> allowed = known.at(table);
    if (table.empty())
        for (const auto& [other, names] : known)
            if (!other.empty()) allowed.push_back("[" + other + "]");
    return quoted_list(allowed);
}

void refuse_unknown(const TomlDocument& document, const toml::table& table, const std::string& table_name,
                    const KeysOfTables& known) {
    for (const auto& [key, value] : table) {
        const std::string name(key.str());
        if (table_name.empty() && name == sweep_table && value.is_table()) continue;
        const bool is_table = table_name.empty() && !name.empty() && known.contains(name);
        if (is_table && !value.is_table())
            throw InputError({name, document.written(value.source()),
                              "is " + type_name(value) + ", and must be a table", "[" + name + "]",
                              fmt::format("Write [{}] and below it the keys {}", name, quoted_list(known.at(name))),
                              document.place(value.source())});
        if (is_table) refuse_unknown(document, *value.as_table(), name, known);
        if (is_table || has(known.at(table_name), name)) continue;
        const bool heading = value.is_table();
        throw InputError({full_key(table_name, document.written(key.source())),
                          heading ? "" : document.written(value.source()),
                          heading ? "is an unknown table" : "is an unknown key", allowed_in(table_name, known),
                          suggestion_for(name, table_name, known), document.place(key.source())});
    }
}

}  // namespace

bool is_scene_key(std::string_view key) {
    const KeysOfTables known = keys_of_tables();
    const auto [table, name] = parts_of_key(key);
    const auto found = known.find(table);
    return found != known.end() && has(found->second, name);
}

void refuse_unknown_keys(const TomlDocument& document) {
    refuse_unknown(document, document.root(), "", keys_of_tables());
}

void refuse_unknown_key(std::string_view key, const std::string& value, const Place& place) {
    if (is_scene_key(key)) return;
    const KeysOfTables known = keys_of_tables();
    const auto [table, name] = parts_of_key(key);
    const bool known_table = known.contains(table);
    std::string suggestion;
    if (const std::string* other = table_with(name, table, known))
        suggestion = fmt::format("Did you mean \"{}\"?", full_key(*other, name));
    else
        suggestion = known_table ? nearest_key(name, std::string(table), known) : nearest_key(table, "", known);
    throw InputError({std::string(key), value, known_table ? "is an unknown key" : "is in an unknown table",
                      allowed_in(known_table ? std::string(table) : "", known), suggestion, place});
}

}  // namespace jostle
