#include "jostle/hydrodynamics/ewald_split.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace jostle {

namespace {

using std::numbers::pi;

/// What leaves at most an error `tolerance`: the Gaussians are cut at exp(-decay^2), in real space and in that of
/// waves, and blobs are spread over so many points of a grid that is finer than the waves need by `fineness`.
/// Measured: tests/unit/hydrodynamics/test_hydrodynamic_mobility.cpp (of 12 spheres, 1.3e-3 with what is listed for
/// 2e-3).
struct Accuracy {
    double tolerance, decay;
    int spread_points;
    double fineness;
};
constexpr std::array<Accuracy, 7> accuracies{{{5e-3, 2.0, 4, 1.0},
                                              {2e-3, 2.3, 5, 1.0},
                                              {1e-3, 2.45, 5, 1.05},
                                              {2e-4, 2.6, 6, 1.1},
                                              {2e-5, 3.1, 7, 1.25},
                                              {2e-6, 3.5, 9, 1.3},
                                              {1e-7, 4.0, 11, 1.3}}};

const Accuracy& accuracy_of(double tolerance) {
    const auto found =
        std::find_if(accuracies.begin(), accuracies.end(), [&](const Accuracy& a) { return a.tolerance <= tolerance; });
    return found == accuracies.end() ? accuracies.back() : *found;
}

/// The next even number, at least `least`, without prime factors above 5.
std::size_t transform_length(double least) {
    for (auto n = static_cast<std::size_t>(std::max(2.0, std::ceil(least)));; ++n) {
        if (n % 2 != 0) continue;
        std::size_t rest = n;
        for (const std::size_t factor : {2, 3, 5})
            while (rest % factor == 0) rest /= factor;
        if (rest == 1) return n;
    }
}

/// 1/(4 xi^2) for which the near flow at the cutoff has fallen to exp(-decay^2): it falls as w exp(-r^2/(4 (spread +
/// w)))/(spread + w), w = 1/(4 xi^2).
double width_of_split(double cutoff, double decay, double spread) {
    double low = 0.0, high = 0.25 * cutoff * cutoff / (decay * decay);
    for (int halvings = 0; halvings < 60; ++halvings) {
        const double w = 0.5 * (low + high);
        const double fallen = 0.25 * cutoff * cutoff / (spread + w) + std::log1p(spread / w);
        (fallen > decay * decay ? low : high) = w;
    }
    return low;
}

/// Couples' waves have a factor k more than those of forces, so that shorter ones are needed: with this, a sphere alone
/// turns as exactly as it moves (tolerances 1e-2 to 2e-5, boxes of 3 to 9 D).
constexpr double shorter_waves_of_couples = 1.15;

/// That the grid holds.
double largest_wave(double width, const Accuracy& accuracy, const EwaldLoad& load) {
    const double narrowest = std::min(load.spread, load.couple_spread.value_or(load.spread));
    const double finer = load.couple_spread ? shorter_waves_of_couples : 1.0;
    return finer * accuracy.fineness * accuracy.decay / std::sqrt(width + narrowest);
}

EwaldSplit with_cutoff(double cutoff, const Accuracy& accuracy, const Box& box, const EwaldLoad& load) {
    const double width = width_of_split(cutoff, accuracy.decay, load.spread);
    EwaldSplit split{
        .cutoff = cutoff, .splitting = 0.5 / std::sqrt(width), .spread_points = accuracy.spread_points, .grid = {}};
    const double largest = largest_wave(width, accuracy, load);
    for (int k = 0; k < 3; ++k)
        split.grid[static_cast<std::size_t>(k)] =
            transform_length(std::max(box.edges()[k] * largest / pi, double(accuracy.spread_points)));
    return split;
}

/// Nanoseconds of one application of M, with its part of what is done once a step: measured on one core.
double cost(const EwaldSplit& split, const Box& box, const EwaldLoad& load) {
    constexpr double for_block = 40.0, for_blob_pair = 2.0, for_grid_point = 100.0, for_spread_point = 3.0;
    const double density = load.rods / box.volume();
    const double length = load.longest_line, r = split.cutoff;
    // Spherocylinders of length 2 l and radius r about segments: the mean excluded volume of isotropic rods.
    const double range_volume = 4.0 / 3.0 * pi * r * r * r + 2.0 * pi * r * r * length + 0.5 * pi * r * length * length;
    const double blocks = density * range_volume;
    const double points = double(split.grid[0]) * double(split.grid[1]) * double(split.grid[2]);
    const double spreading = std::pow(split.spread_points, 3.0) * for_spread_point;
    return load.rods * blocks * (for_block + for_blob_pair * load.blobs_per_rod * load.blobs_per_rod) +
           for_grid_point * points + load.rods * load.blobs_per_rod * spreading;
}

}  // namespace

EwaldSplit ewald_split(double tolerance, std::optional<double> cutoff, const Box& box, const EwaldLoad& load) {
    const Accuracy& accuracy = accuracy_of(tolerance);
    if (cutoff) return with_cutoff(*cutoff, accuracy, box, load);
    const double width = std::sqrt(load.spread);
    EwaldSplit best;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 30; ++k) {  // from 5 to 30 widths of a blob: 1.4 D to 9 D for spheres
        const EwaldSplit split = with_cutoff(5.0 * width * std::pow(1.0645, k), accuracy, box, load);
        const double now = cost(split, box, load);
        if (now >= least) continue;
        least = now;
        best = split;
    }
    return best;
}

}  // namespace jostle
