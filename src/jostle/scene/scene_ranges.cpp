#include "jostle/scene/scene_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "jostle/error/refuse.hpp"
#include "jostle/scene/mistakes.hpp"
#include "jostle/scene/number_text.hpp"
#include "jostle/scene/scene_keys.hpp"
#include "jostle/scene/unused_keys.hpp"

namespace jostle {

namespace {

/// The range in words; the bounds that only keep products finite are named when the value breaks them.
std::string describe(const Range& range, double value) {
    const bool finite = std::isfinite(value);
    std::string words;
    const bool technical = range.lower == Range::smallest || range.lower == Range::smallest_length;
    if (technical && !(value > 0.0 && value < range.lower))
        words = "greater than 0";
    else if (range.lower > -Range::largest || (finite && value < range.lower))
        words = fmt::format("{} {:.10g}", range.lower_included ? "at least" : "greater than", range.lower);
    const bool limited = range.upper < Range::largest && range.upper != Range::largest_length;
    if (limited || (finite && value > range.upper))
        words += fmt::format("{}{} {:.10g}", words.empty() ? "" : " and ",
                             range.upper_included ? "at most" : "less than", range.upper);
    return words.empty() ? "a finite number" : words;
}

/// Range check of one key, by the type of its member.
struct RangeCheck {
    std::string key;
    int dimensions;  ///< of vectors

    void check(double value, const Range& range) const {
        if (range.contains(value)) return;
        const char* problem = "is outside the allowed range";
        if (!std::isfinite(value))
            problem = "is not a finite number";
        else if (value < 0.0 && range.lower >= 0.0)
            problem = "is negative";
        else if (value == 0.0)
            problem = "is zero";
        refuse(key, text(value), problem, describe(range, value), "");
    }

    void operator()(double value, const Quantity& quantity) const { check(value, quantity.range); }
    void operator()(const std::optional<double>& value, const Quantity& quantity) const {
        if (value) check(*value, quantity.range);
    }
    void operator()(const Vec3& value, const Quantity& quantity) const {
        for (int k = 0; k < dimensions; ++k) check(value[k], quantity.range);
    }
    void operator()(const std::optional<Vec3>& value, const Quantity& quantity) const {
        if (value) (*this)(*value, quantity);
    }
    void operator()(std::uint64_t value, const Count& count) const {
        if (value >= count.lower && value <= count.upper) return;
        refuse(key, std::to_string(value), "is outside the allowed range",
               value < count.lower ? fmt::format("at least {}", count.lower) : fmt::format("at most {}", count.upper),
               "");
    }
    void operator()(const std::optional<std::uint64_t>& value, const Count& count) const {
        if (value) (*this)(*value, count);
    }
    template <class Value>
    void operator()(const Ramp<Value>& ramp, const Quantity& quantity) const {
        double last = 0.0;
        for (const auto& [time, value] : ramp) {
            if (!(time > last) || !(time <= Range::largest))
                refuse(key, text(time),
                       last == 0.0 ? "is no time after 0, at which a ramp begins with the value of the scene"
                                   : fmt::format("is no later than the time of the point before, {}", last),
                       "times that increase", "Write the points [time, value] in the order of their times");
            (*this)(value, quantity);
            last = time;
        }
    }
    template <class Member>
    void operator()(const Member&, const Plain&) const {}
};

}  // namespace

void require_ranges(const Scene& scene) {
    const std::vector<UnusedKey> unused = unused_keys(scene);
    Mistakes mistakes;
    for_each_key(scene, [&](std::string_view table, std::string_view name, const auto& member, const auto& spec) {
        const std::string key = full_key(table, name);
        if (std::any_of(unused.begin(), unused.end(), [&](const UnusedKey& entry) { return entry.key == key; })) return;
        mistakes.look([&] { RangeCheck{key, dimensions_of(scene)}(member, spec); });
    });
    mistakes.refuse_any();
}

}  // namespace jostle
