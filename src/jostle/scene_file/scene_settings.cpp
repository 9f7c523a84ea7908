#include "jostle/scene_file/scene_settings.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "jostle/scene/scene_keys.hpp"
#include "jostle/scene_file/scene_reader.hpp"
#include "jostle/scene_file/toml_document.hpp"
#include "jostle/scene_file/unknown_keys.hpp"

namespace jostle {

namespace {

const Place on_command_line{"--set", 0, 0};

std::string trimmed(const std::string& text) {
    const auto begin = text.find_first_not_of(" \t");
    return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

/// Whether the text is one value of TOML on one line, and nothing else.
bool is_toml_value(const std::string& text) {
    if (text.find_first_of("\n\r") != std::string::npos) return false;
    try {
        const TomlDocument document("v = " + text, "");
        const toml::node* value = document.find("", "v");
        return value && document.root().size() == 1 && document.end_of(*value) == text.size() + 4;
    } catch (const InputError&) {
        return false;
    }
}

/// Keys of which a scene has one or the other.
constexpr std::pair<std::string_view, std::string_view> alternatives[] = {
    {"box.volume_fraction", "box.edges"},
    {"box.area_fraction", "box.edges"},
    {"box.edges", "box.volume_fraction"},
    {"box.edges", "box.area_fraction"},
    {"box.edges", "box.shape"},
    {"schedule.edges", "schedule.volume_fraction"},
    {"schedule.edges", "schedule.area_fraction"},
    {"schedule.volume_fraction", "schedule.edges"},
    {"schedule.area_fraction", "schedule.edges"},
    {"time.step", "time.rms_step"},
    {"time.step", "time.accuracy"},
    {"time.rms_step", "time.step"},
    {"time.rms_step", "time.accuracy"},
    {"time.accuracy", "time.step"},
    {"time.accuracy", "time.rms_step"}};

bool sets(const std::vector<Setting>& settings, std::string_view key) {
    return std::any_of(settings.begin(), settings.end(), [&](const Setting& setting) { return setting.key == key; });
}

Setting parse_setting(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || trimmed(text.substr(0, equals)).empty())
        throw InputError({"--set", text, "is not of the form KEY=VALUE", "", "Write --set box.volume_fraction=0.3"});
    Setting setting{trimmed(text.substr(0, equals)), trimmed(text.substr(equals + 1))};
    refuse_unknown_key(setting.key, setting.value, on_command_line);
    if (setting.value.empty())
        throw InputError(
            {setting.key, "", "has no value", "", "Write --set " + setting.key + "=VALUE", on_command_line});
    if (!is_toml_value(setting.value)) setting.value = toml_text(setting.value);
    return setting;
}

/// `in_settings` of one mistake.
InputError alone_in_settings(const std::filesystem::path& scene_path, const std::vector<Setting>& settings,
                             const InputError& error) {
    const auto found = std::find_if(settings.begin(), settings.end(),
                                    [&](const Setting& setting) { return setting.key == error.parts().key; });
    if (found == settings.end()) return is_scene_key(error.parts().key) ? in_scene_file(scene_path, error) : error;
    InputError::Parts parts = error.parts();
    parts.value = found->value;
    parts.place = on_command_line;
    return InputError(parts);
}

}  // namespace

std::vector<Setting> parse_settings(const std::vector<std::string>& texts) {
    std::vector<Setting> settings;
    for (const std::string& text : texts) {
        Setting setting = parse_setting(text);
        const bool twice = std::any_of(settings.begin(), settings.end(),
                                       [&](const Setting& other) { return other.key == setting.key; });
        if (twice)
            throw InputError({setting.key, setting.value, "is set twice", "", "Keep one of the two", on_command_line});
        settings.push_back(std::move(setting));
    }
    return settings;
}

std::string with_settings(std::string_view scene, const std::string& file_name, const std::vector<Setting>& settings) {
    std::string text(scene);
    if (!settings.empty() && has_unknown_keys(TomlDocument(text, file_name)))
        parse_scene(text, file_name);  // tells all
    for (const auto& [key, other] : alternatives) {
        const auto [table, name] = parts_of_key(other);
        if (sets(settings, key) && !sets(settings, other))
            text = TomlDocument(text, file_name).text_without(table, name);
    }
    for (const auto& [key, value] : settings) {
        const auto [table, name] = parts_of_key(key);
        text = TomlDocument(text, file_name).text_with(table, name, value);
    }
    return text;
}

InputError in_settings(const std::filesystem::path& scene_path, const std::vector<Setting>& settings,
                       const InputError& error) {
    if (settings.empty()) return error;
    InputError::Parts parts = error.parts();
    std::vector<InputError> others;
    for (const InputError::Parts& other : parts.others)
        others.push_back(alone_in_settings(scene_path, settings, InputError(other)));
    parts.others.clear();
    return alone_in_settings(scene_path, settings, InputError(std::move(parts))).with_others(others);
}

}  // namespace jostle
