#include "keys_command.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "jostle/scene/scene_keys.hpp"
#include "jostle/scene/units.hpp"

using namespace jostle;

namespace {

template <class Member>
struct IsOptional : std::false_type {};
template <class Value>
struct IsOptional<std::optional<Value>> : std::true_type {};

template <class Member>
struct IsRamp : std::false_type {};
template <class Value>
struct IsRamp<Ramp<Value>> : std::true_type {};

// One overload a kind of key: kind, allowed values and dimension.

template <class Member>
nlohmann::json description(const Member&, const Quantity& quantity) {
    constexpr bool is_vector = std::is_same_v<Member, Vec3> || std::is_same_v<Member, std::optional<Vec3>>;
    const Range& range = quantity.range;
    const bool is_ramp_of_vectors = std::is_same_v<Member, Ramp<Vec3>>;
    return {{"kind", is_ramp_of_vectors      ? "[time, three numbers]s"
                     : IsRamp<Member>::value ? "[time, number]s"
                     : is_vector             ? "three numbers"
                                             : "number"},
            {"at_least", range.lower},
            {"at_most", range.upper},
            {"ends_included", {range.lower_included, range.upper_included}},
            {"auto", quantity.automatic},
            {"optional", IsOptional<Member>::value || IsRamp<Member>::value},
            {"micro_unit", micro_unit_of(quantity.dimension)}};
}
template <class Member>
nlohmann::json description(const Member&, const Count& count) {
    return {{"kind", "whole number"}, {"at_least", count.lower}, {"at_most", count.upper}, {"auto", count.automatic}};
}
template <class Member>
nlohmann::json description(const Member&, const Plain&) {
    if constexpr (std::is_enum_v<Member>) {
        nlohmann::json allowed = nlohmann::json::array();
        for (const auto& [word, value] : words(Member{})) allowed.push_back(word);
        return {{"kind", "word"}, {"words", allowed}};
    } else if constexpr (std::is_same_v<Member, bool>) {
        return {{"kind", "true or false"}};
    } else if constexpr (std::is_same_v<Member, std::string>) {
        return {{"kind", "text"}};
    } else {
        return {{"kind", "three of true or false"}};
    }
}

/// "> 0 and <= 1, pN um-2, or \"auto\"" for people.
std::string allowed_values(const nlohmann::json& key) {
    std::string text;
    if (key.contains("words")) {
        for (const auto& word : key["words"]) text += (text.empty() ? "" : ", ") + word.get<std::string>();
        return text;
    }
    if (!key.contains("at_least")) return text;
    const bool whole = key["kind"] == "whole number";
    const auto bound = [&](const char* name) {
        return whole ? fmt::format("{}", key[name].get<std::uint64_t>()) : fmt::format("{:g}", key[name].get<double>());
    };
    const bool lower = whole || key["ends_included"][0].get<bool>(),
               upper = whole || key["ends_included"][1].get<bool>();
    text = fmt::format("{} {} to {}{}", lower ? "from" : "above", bound("at_least"), upper ? "" : "below ",
                       bound("at_most"));
    if (!whole && !key["micro_unit"].get<std::string>().empty())
        text += fmt::format(" ({})", readable_unit(key["micro_unit"].get<std::string>()));
    if (key["auto"].get<bool>()) text += ", or \"auto\"";
    return text;
}

}  // namespace

ExitCode keys_command(bool json) {
    nlohmann::json keys = nlohmann::json::array();
    const Scene scene;
    for_each_key(scene, [&](std::string_view table, std::string_view name, const auto& member, const auto& spec) {
        nlohmann::json key = description(member, spec);
        key["key"] = full_key(table, name);
        key["may_change"] = spec.may_change;
        keys.push_back(std::move(key));
    });
    if (json) {
        std::printf("%s\n", keys.dump(1).c_str());
        return ExitCode::done;
    }
    for (const auto& key : keys)
        std::printf("%-32s %-23s %s\n", key["key"].get<std::string>().c_str(), key["kind"].get<std::string>().c_str(),
                    allowed_values(key).c_str());
    return ExitCode::done;
}
