#include "jostle/simulation/work.hpp"

#include <algorithm>

namespace jostle {

namespace {

/// Cuts are moved where a rank has more work than this many times the mean of so many steps.
constexpr double uneven = 1.15;
constexpr std::uint64_t measured_steps = 20;

}  // namespace

bool Work::is_uneven(const Ranks& ranks) const {
    if (steps < measured_steps) return false;
    const double most = ranks.largest(seconds);
    const double all = 1e-9 * static_cast<double>(ranks.sum(static_cast<std::int64_t>(1e9 * seconds)));
    return most * ranks.count() > uneven * all;
}

double Work::of_rod(const Ranks& ranks, std::size_t own_rods) const {
    const bool is_measured = steps >= measured_steps && (own_rods == 0 || seconds > 0.0);
    if (ranks.any(!is_measured) || own_rods == 0) return 1.0;
    return seconds / static_cast<double>(own_rods);
}

}  // namespace jostle
