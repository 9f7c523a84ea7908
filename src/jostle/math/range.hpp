#pragma once

#include <cmath>

namespace jostle {

/// The numbers that a key of a scene, or a column of a table, admits. Magnitudes lie within 1e-30 and 1e30, so that no
/// product of a few of them overflows.
struct Range {
    double lower = smallest;
    double upper = largest;
    bool upper_included = true;
    bool lower_included = true;

    static constexpr double smallest = 1e-30;
    static constexpr double largest = 1e30;
    static constexpr double smallest_length = 1e-15;  ///< of rods: squares of their lengths do not overflow in float
    static constexpr double largest_length = 1e15;

    bool contains(double value) const {  // false for nan
        if (value != 0.0 && std::fabs(value) < smallest) return false;
        return (lower_included ? value >= lower : value > lower) && (upper_included ? value <= upper : value < upper);
    }
};

}  // namespace jostle
