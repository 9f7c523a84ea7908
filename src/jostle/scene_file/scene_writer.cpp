#include "jostle/scene_file/scene_writer.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <type_traits>
#include <vector>

#include "jostle/scene/scene_keys.hpp"
#include "jostle/scene/units.hpp"
#include "jostle/scene/unused_keys.hpp"
#include "jostle/scene_file/toml_document.hpp"

namespace jostle {

namespace {

// One overload a type of member; a number is the shortest that reads back as the same double. Vectors have as many
// numbers as the box has dimensions.

std::string written(double value, int /*dimensions*/ = 3) {
    std::string text = fmt::format("{}", value);
    if (text.find_first_not_of("0123456789-") == std::string::npos) text += ".0";  // 5 would read as a whole number
    return text;
}

std::string written(const Vec3& value, int dimensions) {
    if (dimensions == 2) return fmt::format("[{}, {}]", written(value.x), written(value.y));
    return fmt::format("[{}, {}, {}]", written(value.x), written(value.y), written(value.z));
}

std::string written(bool value, int /*dimensions*/) {
    return value ? "true" : "false";
}

std::string written(const std::array<bool, 3>& value, int dimensions) {
    if (dimensions == 2) return fmt::format("[{}, {}]", value[0], value[1]);
    return fmt::format("[{}, {}, {}]", value[0], value[1], value[2]);
}

std::string written(std::uint64_t value, int /*dimensions*/) {
    return std::to_string(value);
}

std::string written(const std::string& value, int /*dimensions*/) {
    return toml_text(value);
}

template <class Choice>
requires std::is_enum_v<Choice> std::string written(Choice value, int /*dimensions*/) {
    return fmt::format("\"{}\"", word_of(value));
}

/// Empty: the key is left out.
template <class Number>
std::string written(const std::optional<Number>& value, int dimensions) {
    return value ? written(*value, dimensions) : "";
}

/// Empty: the key is left out.
template <class Value>
std::string written(const Ramp<Value>& ramp, int dimensions) {
    std::string points;
    for (const auto& [time, value] : ramp)
        points += fmt::format("{}[{}, {}]", points.empty() ? "" : ", ", written(time), written(value, dimensions));
    return points.empty() ? "" : "[" + points + "]";
}

template <class Member>
std::string unit_comment(const Scene& scene, const Member&, const Quantity& quantity) {
    const std::string unit = readable_unit_of(scene, quantity.dimension);
    return unit.empty() ? "" : "  # " + unit;
}
template <class Value>
std::string unit_comment(const Scene& scene, const Ramp<Value>&, const Quantity& quantity) {
    const std::string unit = readable_unit_of(scene, quantity.dimension);
    return fmt::format("  # {}{}{}", readable_unit_of(scene, dimension::time), unit.empty() ? "" : ", ", unit);
}
template <class Member, class Other>
std::string unit_comment(const Scene&, const Member&, const Other&) {
    return "";
}

template <class Spec>
constexpr bool is_automatic(const Spec& spec) {
    if constexpr (requires { spec.automatic; }) return spec.automatic;
    return false;
}

}  // namespace

std::string to_toml(const Scene& scene) {
    const std::vector<UnusedKey> unused = unused_keys(scene);
    std::string text, heading;
    for_each_key(scene, [&](std::string_view table, std::string_view name, const auto& member, const auto& spec) {
        const std::string key = full_key(table, name);
        if (std::any_of(unused.begin(), unused.end(), [&](const UnusedKey& entry) { return entry.key == key; })) return;
        std::string value = written(member, dimensions_of(scene));
        if (value.empty() && is_automatic(spec)) value = "\"auto\"";
        if (value.empty()) return;
        if (table != heading) {
            heading = table;
            text += fmt::format("\n[{}]\n", table);
        }
        text += fmt::format("{} = {}{}\n", name, value, unit_comment(scene, member, spec));
    });
    return text;
}

}  // namespace jostle
