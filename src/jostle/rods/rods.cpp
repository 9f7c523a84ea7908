#include "jostle/rods/rods.hpp"

#include <numbers>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

double rod_volume(double length, double diameter, int dimensions) {
    if (dimensions == 2) return diameter * (length + std::numbers::pi / 4.0 * diameter);
    return std::numbers::pi * diameter * diameter * (length / 4.0 + diameter / 6.0);
}

double total_volume(const Rods& rods, int dimensions) {
    return parallel_sum<double>(
        rods.size(), [&](std::size_t i) { return rod_volume(rods.length[i], rods.diameter[i], dimensions); });
}

}  // namespace jostle
