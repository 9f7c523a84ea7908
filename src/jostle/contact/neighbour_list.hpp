#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "jostle/rods/box.hpp"

namespace jostle {

/// Two rods that may touch before the list is built again; `image` was right when it was built.
struct NeighbourPair {
    std::uint32_t i = 0;
    std::uint32_t j = 0;
    float gap = 0.0F;  ///< when it was built, rounded down
    std::array<std::int16_t, 3> image{};
};

/// Verlet list with a skin over a cell list, for any box: periodic, open, or thinner than a rod is long.
///
/// After `update(rods, box, reach)` the list holds every pair (i, j, image) whose gap is below reach_i + reach_j, where
/// a rod and its own image are a pair too. It is built anew only when some rod has moved so far since the last time
/// that this could fail: a point of rod i moves by at most d_i = |change of centre| + L_i/2 |change of axis|, so pairs
/// with gap < skin at building time suffice as long as d_i + reach_i <= skin/2 for all i.
class NeighbourList {
public:
    /// `travel`: how far a rod may go, beside its reach, before the list is built again (a length).
    explicit NeighbourList(double travel) : travel_(travel) {}

    /// Builds anew if need be; returns whether it did. `reach`: (N), lengths.
    bool update(const Rods& rods, const Box& box, std::span<const double> reach);

    /// Forces building at the next update (rods were added, removed or renumbered).
    void invalidate() { reference_.centre.clear(); }

    /// Pairs in the order of (i, j, image), i <= j.
    std::span<const NeighbourPair> pairs() const { return pairs_; }

    /// Whether the gap of a pair is surely above the reaches given to the last update: most pairs of the skin need no
    /// closer look.
    bool surely_beyond_reach(const NeighbourPair& pair) const {
        return static_cast<double>(pair.gap) > extent_[pair.i] + extent_[pair.j];
    }

    /// The image shift of a pair now: rods that have crossed a periodic face since building are accounted for.
    Image image_now(const NeighbourPair& pair, const Rods& rods) const {
        Image image;
        for (std::size_t k = 0; k < 3; ++k)
            image[k] = pair.image[k] + (rods.image[pair.j][k] - reference_.image[pair.j][k]) -
                       (rods.image[pair.i][k] - reference_.image[pair.i][k]);
        return image;
    }

private:
    double find_extents(const Rods& rods, const Box& box, std::span<const double> reach);
    void build(const Rods& rods, const Box& box, double skin);

    double travel_;
    double skin_ = 0.0;
    struct Reference {
        std::vector<Vec3> centre, axis;
        std::vector<Image> image;
    } reference_;
    std::vector<NeighbourPair> pairs_;
    std::vector<double> extent_;  ///< (N) d_i + reach_i at the last update
};

}  // namespace jostle
