#pragma once

#include <vector>

#include "jostle/rods/rods.hpp"
#include "jostle/scene/scene.hpp"

namespace jostle {

struct RodSize {
    double length = 0.0;
    double diameter = 0.0;
};

/// No rod's length or diameter is farther from the mean than this many standard deviations: what would be is drawn
/// again.
inline constexpr double farthest_deviation = 3.0;

/// Whether all rods of the scene start with the same size. Those of a file need not.
inline bool rods_are_alike(const Scene& scene) {
    return scene.rods.length_deviation == 0.0 && scene.rods.diameter_deviation == 0.0;
}
/// Of a scene without a file: no rod starts longer, none is thicker.
inline double largest_length(const Scene& scene) {
    return scene.rods.length + farthest_deviation * scene.rods.length_deviation;
}
inline double largest_diameter(const Scene& scene) {
    return scene.rods.diameter + farthest_deviation * scene.rods.diameter_deviation;
}

/// The diameter of the thinnest rod; that of the scene where there is none.
double smallest_diameter(const Scene& scene, const Rods& rods);

/// Rods of the sizes and speeds with which those of a scene without a file start, at no places: all of them, by id, or
/// one if all are alike.
Rods representative_rods(const Scene& scene);

/// Length and diameter that each rod starts with, by id (`rods.count`): normal numbers of mean `rods.length` and
/// `rods.diameter` and standard deviations `rods.length_deviation` and `rods.diameter_deviation`, a function of (seed,
/// id). Errors: InputError where no run of so many rods would fit in the memory of this machine.
std::vector<RodSize> rod_sizes(const Scene& scene);

}  // namespace jostle
