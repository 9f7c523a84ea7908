#include "jostle/scene/units.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "jostle/error/input_error.hpp"
#include "jostle/error/nearest_word.hpp"

namespace jostle {

namespace {

/// A unit is factor * 10^power_of_ten in um, s, pN.
struct Unit {
    std::string_view name;
    Dimension dimension;
    int power_of_ten;
    double factor = 1.0;
};

constexpr Unit units[] = {
    {"nm", dimension::length, -3},    {"um", dimension::length, 0},    {"mm", dimension::length, 3},
    {"cm", dimension::length, 4},     {"m", dimension::length, 6},     {"ns", dimension::time, -9},
    {"us", dimension::time, -6},      {"ms", dimension::time, -3},     {"s", dimension::time, 0},
    {"min", dimension::time, 0, 60},  {"h", dimension::time, 0, 3600}, {"fN", dimension::force, -3},
    {"pN", dimension::force, 0},      {"nN", dimension::force, 3},     {"uN", dimension::force, 6},
    {"mN", dimension::force, 9},      {"N", dimension::force, 12},     {"mPa", dimension::stress, -3},
    {"Pa", dimension::stress, 0},     {"kPa", dimension::stress, 3},   {"MPa", dimension::stress, 6},
    {"cP", dimension::viscosity, -3}, {"P", dimension::viscosity, -1}, {"zJ", dimension::energy, -3},
    {"aJ", dimension::energy, 0},     {"fJ", dimension::energy, 3},    {"pJ", dimension::energy, 6},
    {"nJ", dimension::energy, 9},     {"J", dimension::energy, 18},
};

std::string unit_names() {
    std::string list;
    for (const Unit& unit : units) list += (list.empty() ? "" : ", ") + std::string(unit.name);
    return list;
}

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// The text with "u" for either of Unicode's two micro signs, and "?" for control characters, which messages cannot
/// show.
std::string plain_text(std::string_view text) {
    std::string plain(text);
    for (char& c : plain)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = c == '\t' ? ' ' : '?';
    for (const std::string_view sign : {"\u00b5", "\u03bc"})
        for (auto at = plain.find(sign); at != std::string::npos; at = plain.find(sign))
            plain.replace(at, sign.size(), "u");
    return plain;
}

/// Reads a quantity from left to right; what was read so far is number * factor * 10^power_of_ten of `dimension`.
class QuantityParser {
public:
    QuantityParser(std::string_view text, Dimension expected) : text_(plain_text(text)), expected_(expected) {}

    double parse() {
        read_number();
        skip_spaces();
        if (at_end()) refuse("has no unit", "");
        for (int sign = 1; !at_end(); sign = read_operator()) read_unit(sign);
        if (!(dimension_ == expected_)) {
            const std::string unit = micro_unit_of(dimension_);
            refuse("is a quantity in " + (unit.empty() ? "pure numbers" : readable_unit(unit)), "");
        }
        // a quotient of two exact numbers is rounded once; a product with 10^-3 would be rounded twice
        const double scale = std::pow(10.0, std::abs(power_of_ten_));
        return power_of_ten_ < 0 ? number_ * factor_ / scale : number_ * factor_ * scale;
    }

private:
    [[noreturn]] void refuse(std::string problem, std::string suggestion) const {
        const std::string example = example_quantity(expected_);
        if (suggestion.empty()) suggestion = "Write it as \"" + example + "\"";
        throw InputError({"",
                          "\"" + text_ + "\"",
                          std::move(problem),
                          "a number, or a text with a unit of " + readable_unit(micro_unit_of(expected_)),
                          std::move(suggestion),
                          {}});
    }

    bool at_end() const { return position_ == text_.size(); }
    char next() const { return at_end() ? '\0' : text_[position_]; }
    void skip_spaces() {
        while (next() == ' ') ++position_;
    }

    void read_number() {
        skip_spaces();
        if (next() == '+') ++position_;
        const char* end = text_.data() + text_.size();
        const auto [stop, error] = std::from_chars(text_.data() + position_, end, number_);
        if (error == std::errc::invalid_argument) refuse("does not begin with a number", "");
        if (error != std::errc{} || !std::isfinite(number_)) refuse("is not a finite number", "");
        position_ = static_cast<std::size_t>(stop - text_.data());
    }

    /// The operator before a unit: -1 for a division, 1 for a product.
    int read_operator() {
        const char symbol = next();
        if (symbol != '*' && symbol != '/') return 1;
        ++position_;
        skip_spaces();
        if (at_end()) refuse(std::string("ends with \"") + symbol + "\"", "");
        return symbol == '/' ? -1 : 1;
    }

    void read_unit(int sign) {
        const std::size_t begin = position_;
        while (is_letter(next())) ++position_;
        const std::string name = text_.substr(begin, position_ - begin);
        if (name.empty()) refuse("cannot be read from \"" + text_.substr(begin) + "\" on", "");
        const Unit* unit =
            std::find_if(std::begin(units), std::end(units), [&](const Unit& u) { return u.name == name; });
        if (unit == std::end(units)) refuse("has the unknown unit \"" + name + "\"", "Units are " + unit_names());
        const int power = sign * read_power();
        dimension_.length += power * unit->dimension.length;
        dimension_.time += power * unit->dimension.time;
        dimension_.force += power * unit->dimension.force;
        power_of_ten_ += power * unit->power_of_ten;
        factor_ *= std::pow(unit->factor, power);
        skip_spaces();
    }

    int read_power() {
        const bool marked = next() == '^';
        if (marked) ++position_;
        if (next() == '+') ++position_;
        int power = 1;
        const auto [stop, error] = std::from_chars(text_.data() + position_, text_.data() + text_.size(), power);
        if (error == std::errc::invalid_argument && !marked) return 1;
        if (error != std::errc{} || std::abs(power) > 9)
            refuse("has a power that is not a whole number from -9 to 9", "");
        position_ = static_cast<std::size_t>(stop - text_.data());
        return power;
    }

    std::string text_;
    Dimension expected_;
    std::size_t position_ = 0;
    double number_ = 0.0;
    double factor_ = 1.0;
    int power_of_ten_ = 0;
    Dimension dimension_;
};

std::string product(std::initializer_list<std::pair<const char*, int>> factors) {
    std::string unit;
    for (const auto& [name, power] : factors) {
        if (power == 0) continue;
        if (!unit.empty()) unit += " ";
        unit += name;
        if (power != 1) unit += std::to_string(power);
    }
    return unit;
}

}  // namespace

double parse_quantity(std::string_view text, Dimension expected) {
    return QuantityParser(text, expected).parse();
}

std::string micro_unit_of(Dimension d) {
    return product({{"pN", d.force}, {"um", d.length}, {"s", d.time}});
}

std::string unit_of(const Scene& scene, Dimension d) {
    if (scene.units.system == UnitSystem::micro) return micro_unit_of(d);
    const char* length = scene.rods.diameter == 1.0 ? "D" : "length_unit";
    const char* viscosity = scene.fluid.viscosity == 1.0 ? "mu" : "viscosity_unit";
    if (scene.fluid.kT != 1.0)  // force = viscosity length^2/time
        return product({{length, d.length + 2 * d.force}, {viscosity, d.force}, {"time_unit", d.time - d.force}});
    // force = energy/length, time = viscosity length^3/energy
    return product({{"kT", d.force - d.time}, {length, d.length - d.force + 3 * d.time}, {viscosity, d.time}});
}

std::string unit_of_stress(const Scene& scene) {
    return unit_of(scene, dimensions_of(scene) == 2 ? dimension::stress_in_plane : dimension::stress);
}

std::string unit_of_number_density(const Scene& scene) {
    return unit_of(scene, dimensions_of(scene) == 2 ? dimension::number_density_in_plane : dimension::number_density);
}

std::string example_quantity(Dimension d) {
    if (d == dimension::length) return "300 nm";
    if (d == dimension::time) return "35.1 s";
    if (d == dimension::speed) return "2 um/s";
    if (d == dimension::viscosity) return "1e-3 Pa s";
    if (d == dimension::energy) return "0.00411 pN um";
    return "1 " + micro_unit_of(d);
}

}  // namespace jostle
