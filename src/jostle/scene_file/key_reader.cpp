#include "jostle/scene_file/key_reader.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "jostle/error/nearest_word.hpp"
#include "jostle/scene/units.hpp"

namespace jostle {

namespace {

constexpr const char* number_letters = "0123456789.eE+-";

bool looks_like_number(const std::string& text) {
    return text.find_first_of("0123456789") != std::string::npos &&
           text.find_first_not_of(number_letters) == std::string::npos;
}

}  // namespace

std::string type_name(const toml::node& node) {
    if (node.is_string()) return "a text";
    if (node.is_integer()) return "a whole number";
    if (node.is_floating_point()) return "a number with a decimal point or exponent";
    if (node.is_boolean()) return "true or false";
    if (node.is_array()) return "an array";
    return node.is_table() ? "a table" : "a date or time";
}

void KeyReader::read(const toml::node& node, std::string& member, const Plain&) const {
    if (!node.is_string()) refuse_type(node, "a text in quotes");
    member = node.as_string()->get();
}

void KeyReader::read(const toml::node& node, bool& member, const Plain&) const {
    if (!node.is_boolean()) refuse_type(node, "true or false, without quotes");
    member = node.as_boolean()->get();
}

void KeyReader::read(const toml::node& node, std::array<bool, 3>& member, const Plain&) const {
    const toml::array& values = vector(node, "true");
    member = {};
    for (std::size_t k = 0; k < values.size(); ++k) read(values[k], member[k], Plain{});
}

void KeyReader::read(const toml::node& node, std::uint64_t& member, const Count& count) const {
    const std::string allowed =
        fmt::format("a whole number of at least {}{}", count.lower, count.automatic ? ", or \"auto\"" : "");
    if (const auto* decimal = node.as_floating_point()) {
        const double value = decimal->get();
        const bool whole = value >= 0.0 && value < 1e15 && value == std::trunc(value);
        refuse(node, "is not a whole number", allowed,
               whole ? fmt::format("Write {:.0f}, without decimal point and exponent", value) : "Write digits only");
    }
    if (!node.is_integer()) refuse_type(node, allowed);
    const std::int64_t value = node.as_integer()->get();
    if (value < 0) refuse(node, "is negative", allowed, "Write digits only");
    member = static_cast<std::uint64_t>(value);
}

void KeyReader::read(const toml::node& node, double& member, const Quantity& quantity) const {
    if (node.is_integer())
        member = static_cast<double>(node.as_integer()->get());
    else if (node.is_floating_point())
        member = node.as_floating_point()->get();
    else if (node.is_string() && !(quantity.dimension == dimension::none))
        member = with_unit(node, quantity);
    else
        refuse_type(node, allowed(quantity));
}

void KeyReader::read(const toml::node& node, Vec3& member, const Quantity& quantity) const {
    const toml::array& values = vector(node, "1");
    member = {};
    for (int k = 0; k < dimensions_; ++k) read(values[static_cast<std::size_t>(k)], member[k], quantity);
}

void KeyReader::refuse(const toml::node& node, std::string problem, std::string allowed, std::string suggestion) const {
    throw InputError({key_, document_.written(node.source()), std::move(problem), std::move(allowed),
                      std::move(suggestion), document_.place(node.source())});
}

void KeyReader::refuse_type(const toml::node& node, const std::string& expected) const {
    std::string suggestion = "Write " + expected;
    if (node.is_string()) {
        const std::string& text = node.as_string()->get();
        if (looks_like_number(text) || text == "true" || text == "false") suggestion = "Remove the quotes: " + text;
    }
    refuse(node, "is " + type_name(node) + ", the wrong type", expected, suggestion);
}

std::string KeyReader::word(const toml::node& node, const std::vector<std::string>& all) const {
    if (!node.is_string()) refuse_type(node, "one of " + quoted_list(all));
    const std::string& given = node.as_string()->get();
    if (std::find(all.begin(), all.end(), given) != all.end()) return given;
    const std::string suggestion = did_you_mean(given, all);
    refuse(node, "is not one of the words of this key", quoted_list(all),
           suggestion.empty() ? "Choose one of these words" : suggestion);
}

const toml::array& KeyReader::vector(const toml::node& node, const std::string& element) const {
    const bool flat = dimensions_ == 2;
    const std::string example = fmt::format("[{}{}{}]", element, ", " + element, flat ? "" : ", " + element);
    if (!node.is_array()) refuse_type(node, fmt::format("an array of {}, as {}", flat ? "two" : "three", example));
    const toml::array& values = *node.as_array();
    if (values.size() != static_cast<std::size_t>(dimensions_))
        refuse(node, fmt::format("has {} elements", values.size()),
               flat ? "two elements with box.dimensions = 2: x, y" : "three elements: x, y, z",
               "Write it as " + example);
    return values;
}

/// Time and value of each point of a ramp.
std::vector<std::pair<const toml::node*, const toml::node*>> KeyReader::points(const toml::node& node,
                                                                               bool of_vectors) const {
    const char* of_edges = dimensions_ == 2 ? "[[50.0, [12.0, 12.0]]]" : "[[50.0, [12.0, 12.0, 12.0]]]";
    const std::string example = of_vectors ? of_edges : "[[50.0, 0.2], [80.0, 0.2]]";
    if (!node.is_array() || node.as_array()->empty()) refuse_type(node, "points [time, value], as " + example);
    std::vector<std::pair<const toml::node*, const toml::node*>> points;
    for (const toml::node& point : *node.as_array()) {
        const toml::array* pair = point.as_array();
        if (!pair || pair->size() != 2)
            refuse(point, "is no point of a ramp", "[time, value]", "Write the points as " + example);
        points.emplace_back(pair->get(0), pair->get(1));
    }
    return points;
}

std::string KeyReader::allowed(const Quantity& quantity) const {
    std::string text = "a number";
    const bool micro = units_ == UnitSystem::micro;
    const std::string unit =
        readable_unit(micro ? micro_unit_of(quantity.dimension) : unit_of(Scene{}, quantity.dimension));
    if (!unit.empty()) text += " in " + unit;
    if (micro && !unit.empty()) text += ", or with its unit as \"" + example_quantity(quantity.dimension) + "\"";
    return quantity.automatic ? text + ", or \"auto\"" : text;
}

double KeyReader::with_unit(const toml::node& node, const Quantity& quantity) const {
    const std::string& text = node.as_string()->get();
    const bool has_digits = text.find_first_of("0123456789") != std::string::npos;
    if (quantity.automatic && !has_digits)
        refuse(node, "is neither a number nor \"auto\"", allowed(quantity), "Did you mean \"auto\"?");
    if (!has_digits || looks_like_number(text)) refuse_type(node, allowed(quantity));
    if (units_ == UnitSystem::reduced)
        refuse(node, "carries a unit, and the scene is in reduced units", allowed(quantity),
               "Write the number alone, or set units.system = \"micro\"");
    try {
        return parse_quantity(text, quantity.dimension);
    } catch (const InputError& error) {
        refuse(node, error.parts().problem, allowed(quantity), error.parts().suggestion);
    }
}

}  // namespace jostle
