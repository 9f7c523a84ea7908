#pragma once

#include <cstdint>

#include "jostle/simulation/scene.hpp"

namespace jostle {

struct RodSize {
    double length = 0.0;
    double diameter = 0.0;
};

/// No rod's length or diameter is farther from the mean than this many standard deviations: what would be is drawn
/// again.
inline constexpr double farthest_deviation = 3.0;

/// Length and diameter that the rod with this id starts with: normal numbers of mean `rods.length` and `rods.diameter`
/// and standard deviations `rods.length_deviation` and `rods.diameter_deviation`, a function of (seed, id).
RodSize rod_size(const Scene& scene, std::uint64_t id);

/// Whether all rods of the scene start alike. Those of a file need not.
inline bool rods_are_alike(const Scene& scene) {
    return scene.rods.length_deviation == 0.0 && scene.rods.diameter_deviation == 0.0;
}

}  // namespace jostle
