#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "jostle/scene/scene_keys.hpp"
#include "jostle/scene_file/toml_document.hpp"

namespace jostle {

/// The type of a TOML value in words, as "a whole number".
std::string type_name(const toml::node& node);

/// Reads the value of one key into its member of the scene; the overloads follow the member's type.
///
/// Checks the type, the words and the units; ranges are left to `validate`. Numbers may carry units in the micro
/// system. Throws InputError with the place and the value as written.
class KeyReader {
public:
    /// Vectors have as many numbers as the box has dimensions: of two, the third stays 0, or false.
    KeyReader(const TomlDocument& document, UnitSystem units, int dimensions, std::string key)
        : document_(document), units_(units), dimensions_(dimensions), key_(std::move(key)) {}

    void read(const toml::node& node, std::string& member, const Plain&) const;
    void read(const toml::node& node, bool& member, const Plain&) const;
    void read(const toml::node& node, std::array<bool, 3>& member, const Plain&) const;
    void read(const toml::node& node, std::uint64_t& member, const Count& count) const;
    void read(const toml::node& node, double& member, const Quantity& quantity) const;
    void read(const toml::node& node, Vec3& member, const Quantity& quantity) const;

    template <class Value>
    void read(const toml::node& node, Ramp<Value>& member, const Quantity& quantity) const {
        member.clear();
        for (const auto& [time, value] : points(node, std::is_same_v<Value, Vec3>)) {
            read(*time, member.emplace_back().time, Quantity{dimension::time, positive});
            read(*value, member.back().value, quantity);
        }
    }

    template <class Choice>
    requires std::is_enum_v<Choice>
    void read(const toml::node& node, Choice& member, const Plain&) const {
        std::vector<std::string> all;
        for (const auto& [word, choice] : words(Choice{})) all.emplace_back(word);
        const std::string given = word(node, all);
        for (const auto& [word, choice] : words(Choice{}))
            if (word == given) member = choice;
    }

    template <class Number, class Spec>
    void read(const toml::node& node, std::optional<Number>& member, const Spec& spec) const {
        member.reset();
        if (spec.automatic && node.is_string() && node.as_string()->get() == "auto") return;
        read(node, member.emplace(), spec);
    }

private:
    [[noreturn]] void refuse(const toml::node& node, std::string problem, std::string allowed,
                             std::string suggestion) const;
    [[noreturn]] void refuse_type(const toml::node& node, const std::string& expected) const;
    std::string word(const toml::node& node, const std::vector<std::string>& all) const;
    const toml::array& vector(const toml::node& node, const std::string& element) const;
    std::vector<std::pair<const toml::node*, const toml::node*>> points(const toml::node& node, bool of_vectors) const;
    std::string allowed(const Quantity& quantity) const;
    double with_unit(const toml::node& node, const Quantity& quantity) const;

    const TomlDocument& document_;
    UnitSystem units_;
    int dimensions_;
    std::string key_;
};

}  // namespace jostle
