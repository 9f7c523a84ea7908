#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "jostle/rods/box.hpp"

namespace jostle {

/// Of any split, along a direction.
inline constexpr std::size_t max_spread_points = 11;

/// How flows in a periodic box are split between pairs of rods and a grid (theory, section 7.3).
struct EwaldSplit {
    double cutoff = 0.0;     ///< of blobs in real space; a length
    double splitting = 0.0;  ///< xi; 1/length
    int spread_points = 0;   ///< of the grid, along each direction, that a blob is spread over
    std::array<std::size_t, 3> grid{};

    bool operator==(const EwaldSplit&) const = default;
};

/// What the split is chosen for.
struct EwaldLoad {
    double rods = 0.0;
    double blobs_per_rod = 1.0;
    double longest_line = 0.0;                           ///< from the first blob to the last
    double spread = 0.0;                                 ///< of a blob; length^2
    std::optional<double> couple_spread = std::nullopt;  ///< of a couple, where couples act; length^2
};

/// The split of relative error `tolerance`, 1e-6 to 1e-2, with this cutoff, or with that which costs least by a count
/// of the work: a function of its arguments, not of any time.
EwaldSplit ewald_split(double tolerance, std::optional<double> cutoff, const Box& box, const EwaldLoad& load);

}  // namespace jostle
