#include "jostle/scene/key_values.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <optional>
#include <type_traits>

#include "jostle/scene/number_text.hpp"
#include "jostle/scene/scene_keys.hpp"
#include "jostle/scene/unused_keys.hpp"

namespace jostle {

namespace {

std::string in_words(bool value) {
    return value ? "true" : "false";
}
std::string in_words(const std::string& value) {
    return value;
}
std::string in_words(const Vec3& value) {
    return text(value);
}
template <class Value>
std::string in_words(const Value& value) {
    if constexpr (std::is_enum_v<Value>)
        return std::string(word_of(value));
    else
        return fmt::format("{}", value);
}
template <class Value>
std::string in_words(const std::optional<Value>& value) {
    return value ? in_words(*value) : "auto";
}
std::string in_words(const std::array<bool, 3>& value) {
    return text(value);
}

template <class Value>
std::string in_words(const Ramp<Value>& ramp) {
    std::string points;
    for (const auto& [time, value] : ramp)
        points += fmt::format("{}[{}, {}]", points.empty() ? "" : ", ", in_words(time), in_words(value));
    return ramp.empty() ? "none" : "[" + points + "]";
}

bool is_unused(const std::string& key, const std::vector<UnusedKey>& unused) {
    return std::any_of(unused.begin(), unused.end(), [&](const UnusedKey& entry) { return entry.key == key; });
}

}  // namespace

std::vector<KeyValue> key_values(const Scene& scene) {
    std::vector<KeyValue> values;
    for_each_key(scene, [&](const char* table, const char* name, const auto& member, const auto& spec) {
        values.push_back({full_key(table, name), in_words(member), spec.may_change});
    });
    return values;
}

std::string physics_difference(const Scene& before, const Scene& now) {
    const auto earlier = key_values(before), later = key_values(now);
    const auto unused_before = unused_keys(before), unused_now = unused_keys(now);
    std::string first;
    int others = -1;
    for (std::size_t k = 0; k < earlier.size(); ++k) {
        const std::string& key = earlier[k].key;
        if (earlier[k].may_change || earlier[k].text == later[k].text) continue;
        if (is_unused(key, unused_before) || is_unused(key, unused_now)) continue;
        if (first.empty()) first = fmt::format("{} was {} and is {}", key, earlier[k].text, later[k].text);
        ++others;
    }
    if (others <= 0) return first;
    return first + fmt::format(", and {} other key{}", others, others == 1 ? " differs" : "s differ");
}

}  // namespace jostle
