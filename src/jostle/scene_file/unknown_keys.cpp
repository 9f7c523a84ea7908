#include "jostle/scene_file/unknown_keys.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "jostle/error/nearest_word.hpp"
#include "jostle/scene/mistakes.hpp"
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

/// What people call a key, beside its name here; lower-case, without underscores.
constexpr std::pair<std::string_view, std::string_view> other_names[] = {
    {"dt", "time.step"},
    {"timestep", "time.step"},
    {"temperature", "fluid.kT"},
    {"temp", "fluid.kT"},
    {"kbt", "fluid.kT"},
    {"aspectratio", "rods.length"},
    {"randomseed", "seed"},
    {"rngseed", "seed"},
    {"n", "rods.count"},
    {"number", "rods.count"},
    {"nrods", "rods.count"},
    {"numberofrods", "rods.count"},
    {"numparticles", "rods.count"},
    {"phi", "box.volume_fraction"},
    {"packingfraction", "box.volume_fraction"},
    {"density", "box.volume_fraction"},
    {"boxsize", "box.edges"},
    {"boxlength", "box.edges"},
    {"pbc", "box.periodic"},
    {"l", "rods.length"},
    {"d", "rods.diameter"},
    {"width", "rods.diameter"},
    {"radius", "rods.diameter"},
    {"mu", "fluid.viscosity"},
    {"eta", "fluid.viscosity"},
    {"velocity", "motion.self_propulsion"},
    {"speed", "motion.self_propulsion"},
    {"activity", "motion.self_propulsion"},
    {"duration", "time.production"},
    {"totaltime", "time.production"},
    {"tend", "time.production"},
    {"nsteps", "time.production"},
    {"runtime", "time.production"},
    {"growthrate", "growth.rate"},
};
/// What there is to say beside the key.
constexpr std::pair<std::string_view, std::string_view> remarks[] = {
    {"aspectratio", "it is that of the cylinder, so L/D times diameter"},
    {"radius", "it is twice the radius"},
    {"density", "of the rods; or edges give the box"},
    {"temperature", "an energy"},
    {"temp", "an energy"},
    {"nsteps", "a time"},
};

std::string plain(std::string_view name) {
    std::string letters;
    for (const char c : name)
        if (c != '_' && c != '-' && c != ' ') letters += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return letters;
}

/// The key that people mean by another name of it, with what there is to say beside; "" if this is none.
std::pair<std::string_view, std::string> meant_by(std::string_view name) {
    const std::string letters = plain(name);
    const auto named = [&](const auto& entry) { return entry.first == letters; };
    const auto key = std::find_if(std::begin(other_names), std::end(other_names), named);
    if (key == std::end(other_names)) return {};
    const auto remark = std::find_if(std::begin(remarks), std::end(remarks), named);
    return {key->second, remark == std::end(remarks) ? "" : fmt::format(" ({})", remark->second)};
}

std::string suggestion_by_meaning(std::string_view name) {
    const auto [key, remark] = meant_by(name);
    if (key.empty()) return "";
    const auto [table, own] = parts_of_key(key);
    return fmt::format("It is called \"{}\", {}{}", own,
                       table.empty() ? "at the top" : fmt::format("under [{}]", table), remark);
}

/// What to do about a key that no table, or another one, has.
std::string suggestion_for(std::string_view name, const std::string& table, const KeysOfTables& known) {
    if (const std::string* other = table == "schedule" ? table_with(name, table, known) : nullptr)
        return fmt::format("{}.{} cannot be ramped", *other, name);
    if (const std::string meant = suggestion_by_meaning(name); !meant.empty()) return meant;
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

void find_unknown(const TomlDocument& document, const toml::table& table, const std::string& table_name,
                  const KeysOfTables& known, Mistakes& mistakes) {
    for (const auto& [key, value] : table) {
        const std::string name(key.str());
        if (table_name.empty() && name == sweep_table && value.is_table()) continue;
        const bool is_table = table_name.empty() && !name.empty() && known.contains(name);
        if (is_table && !value.is_table())
            mistakes.add(
                InputError({name, document.written(value.source()), "is " + type_name(value) + ", and must be a table",
                            "[" + name + "]",
                            fmt::format("Write [{}] and below it the keys {}", name, quoted_list(known.at(name))),
                            document.place(value.source())}));
        else if (is_table)
            find_unknown(document, *value.as_table(), name, known, mistakes);
        if (is_table || has(known.at(table_name), name)) continue;
        const bool heading = value.is_table();
        mistakes.add(InputError({full_key(table_name, document.written(key.source())),
                                 heading ? "" : document.written(value.source()),
                                 heading ? "is an unknown table" : "is an unknown key", allowed_in(table_name, known),
                                 suggestion_for(name, table_name, known), document.place(key.source())}));
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
    Mistakes mistakes;
    find_unknown(document, document.root(), "", keys_of_tables(), mistakes);
    mistakes.sort_by_place();
    mistakes.refuse_any();
}

bool has_unknown_keys(const TomlDocument& document) {
    Mistakes mistakes;
    find_unknown(document, document.root(), "", keys_of_tables(), mistakes);
    return !mistakes.empty();
}

void refuse_unknown_key(std::string_view key, const std::string& value, const Place& place) {
    if (is_scene_key(key)) return;
    const KeysOfTables known = keys_of_tables();
    const auto [table, name] = parts_of_key(key);
    const bool known_table = known.contains(table);
    std::string suggestion;
    if (const auto [meant, remark] = meant_by(name); !meant.empty())
        suggestion = fmt::format("It is called \"{}\"{}", meant, remark);
    if (const std::string* other = table_with(name, table, known); other && suggestion.empty())
        suggestion = fmt::format("Did you mean \"{}\"?", full_key(*other, name));
    if (suggestion.empty())
        suggestion = known_table ? nearest_key(name, std::string(table), known) : nearest_key(table, "", known);
    throw InputError({std::string(key), value, known_table ? "is an unknown key" : "is in an unknown table",
                      allowed_in(known_table ? std::string(table) : "", known), suggestion, place});
}

}  // namespace jostle
