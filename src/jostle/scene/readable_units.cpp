#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/units.hpp"

namespace jostle {

namespace {

using Factors = std::vector<std::pair<std::string, int>>;  ///< names and powers

Factors factors_of(std::string_view unit) {
    Factors factors;
    while (!unit.empty()) {
        const std::string_view factor = unit.substr(0, unit.find(' '));
        unit.remove_prefix(std::min(factor.size() + 1, unit.size()));
        const std::string_view name = factor.substr(0, factor.find_last_not_of("-0123456789") + 1);
        int power = 1;
        std::from_chars(factor.data() + name.size(), factor.data() + factor.size(), power);
        if (!name.empty()) factors.emplace_back(name, power);
    }
    return factors;
}

void multiply(Factors& factors, const std::string& name, int power) {
    const auto found = std::find_if(factors.begin(), factors.end(), [&](const auto& f) { return f.first == name; });
    if (found == factors.end())
        factors.emplace_back(name, power);
    else
        found->second += power;
}

std::string powers(const Factors& factors, int sign) {
    std::string text;
    for (const auto& [name, power] : factors)
        if (power * sign > 0)
            text += (text.empty() ? "" : " ") + name + (power == sign ? "" : std::to_string(power * sign));
    return text;
}

std::string quotient(Factors factors) {
    constexpr std::array<std::string_view, 4> first = {"mu", "viscosity_unit", "pN", "kT"};
    const auto place = [&](const auto& f) { return std::find(first.begin(), first.end(), f.first) - first.begin(); };
    std::stable_sort(factors.begin(), factors.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
    const std::string above = powers(factors, 1), below = powers(factors, -1);
    if (below.empty()) return above;
    const bool several = std::count_if(factors.begin(), factors.end(), [](const auto& f) { return f.second < 0; }) > 1;
    return (above.empty() ? "1" : above) + "/" + (several ? "(" + below + ")" : below);
}

}  // namespace

std::string readable_unit(std::string_view unit) {
    return quotient(factors_of(unit));
}

std::string readable_unit_of(const Scene& scene, Dimension dimension) {
    return readable_unit(unit_of(scene, dimension));
}

ReadableUnit readable_unit(const Scene& scene, std::string_view unit) {
    Factors factors = factors_of(unit);
    const auto time =
        std::find_if(factors.begin(), factors.end(), [](const auto& f) { return f.first == "time_unit"; });
    if (time == factors.end() || !grows(scene)) return {1.0, quotient(factors)};
    const int power = time->second;
    factors.erase(time);
    multiply(factors, "D", power);
    multiply(factors, "growth rate", -power);
    return {std::pow(scene.growth.rate / scene.rods.diameter, power), quotient(factors)};
}

}  // namespace jostle
