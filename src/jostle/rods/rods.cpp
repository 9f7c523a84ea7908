#include "jostle/rods/rods.hpp"

#include <algorithm>
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

bool all_alike(const Rods& rods) {
    const auto same = [](const std::vector<double>& values) {
        return std::all_of(values.begin(), values.end(), [&](double value) { return value == values.front(); });
    };
    return same(rods.length) && same(rods.diameter);
}

double mean_aspect_ratio(const Rods& rods) {
    const auto sum =
        parallel_sum<double>(rods.size(), [&](std::size_t i) { return rods.length[i] / rods.diameter[i]; });
    return sum / static_cast<double>(rods.size());
}

}  // namespace jostle
