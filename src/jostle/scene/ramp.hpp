#pragma once

#include <algorithm>
#include <vector>

namespace jostle {

/// Where a ramp has come to at a time.
template <class Value>
struct RampPoint {
    double time = 0.0;
    Value value{};
    bool operator==(const RampPoint&) const = default;
};

/// A value that changes in time: along straight lines from what the scene says at time 0 through these points, whose
/// times increase; after the last it stays. Empty: it does not change.
template <class Value>
using Ramp = std::vector<RampPoint<Value>>;

template <class Value>
Value value_at(const Value& first, const Ramp<Value>& ramp, double time) {
    RampPoint<Value> from{0.0, first};
    for (const RampPoint<Value>& to : ramp) {
        if (time < to.time) return from.value + ((time - from.time) / (to.time - from.time)) * (to.value - from.value);
        from = to;
    }
    return from.value;
}

/// The mean from `begin` to `end` > `begin`, exact but for rounding.
template <class Value>
Value mean_over(const Value& first, const Ramp<Value>& ramp, double begin, double end) {
    if (ramp.empty() || begin >= ramp.back().time) return value_at(first, ramp, begin);
    Value mean{};
    double from = begin;
    const auto add_up_to = [&](double to) {
        if (!(to > from)) return;
        mean = mean + ((to - from) / (end - begin)) * value_at(first, ramp, 0.5 * (from + to));
        from = to;
    };
    for (const RampPoint<Value>& point : ramp) add_up_to(std::min(point.time, end));
    add_up_to(end);
    return mean;
}

}  // namespace jostle
