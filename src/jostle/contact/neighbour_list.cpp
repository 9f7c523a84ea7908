#include "jostle/contact/neighbour_list.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "jostle/contact/cell_list.hpp"
#include "jostle/contact/segment_distance.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

constexpr std::size_t rods_per_block = 64;

/// A rod and its own image: each such pair is met twice, in opposite images; the lexicographically positive one stands
/// for both.
bool is_positive(const Image& image) {
    return image > Image{0, 0, 0};
}

std::array<std::int16_t, 3> narrowed(const Image& image) {
    return {static_cast<std::int16_t>(image[0]), static_cast<std::int16_t>(image[1]),
            static_cast<std::int16_t>(image[2])};
}

float rounded_down(double value) {
    return std::nextafter(static_cast<float>(value), -INFINITY);
}

/// Appends the pairs (i, j >= i, image) with a gap below `skin`, in order.
void append_pairs_of(std::size_t i, const Rods& rods, const Box& box, const CellList& cells, double skin,
                     std::vector<NeighbourPair>& pairs) {
    const std::size_t first = pairs.size();
    const double half_i = 0.5 * rods.length[i];
    cells.visit(rods.centre[i], [&](std::uint32_t j, const Image& image) {
        if (j < i || (j == i && !is_positive(image))) return;
        const Vec3 between = rods.centre[j] + box.displacement(image) - rods.centre[i];
        const double half_j = 0.5 * rods.length[j];
        const double range = 0.5 * (rods.diameter[i] + rods.diameter[j]) + skin;
        const double outer = half_i + half_j + range;
        if (squared_norm(between) >= outer * outer) return;
        const auto points = nearest_points(between, rods.axis[i], half_i, rods.axis[j], half_j);
        if (squared_norm(points.separation) >= range * range) return;
        const double gap = norm(points.separation) - range + skin;
        pairs.push_back({static_cast<std::uint32_t>(i), j, rounded_down(gap), narrowed(image)});
    });
    std::sort(
        pairs.begin() + static_cast<std::ptrdiff_t>(first), pairs.end(),
        [](const NeighbourPair& a, const NeighbourPair& b) { return std::tie(a.j, a.image) < std::tie(b.j, b.image); });
}

}  // namespace

bool NeighbourList::update(const Rods& rods, const Box& box, std::span<const double> reach) {
    if (reference_.centre.size() == rods.size() && find_extents(rods, box, reach) <= 0.5 * skin_) return false;
    const double largest_reach = parallel_max(rods.size(), 0.0, [&](std::size_t i) { return reach[i]; });
    build(rods, box, 2.0 * (largest_reach + travel_));
    extent_.assign(reach.begin(), reach.end());
    return true;
}

/// Fills in d_i + reach_i, and returns the largest.
double NeighbourList::find_extents(const Rods& rods, const Box& box, std::span<const double> reach) {
    return parallel_max(rods.size(), 0.0, [&](std::size_t i) {
        Image crossed;
        for (std::size_t k = 0; k < 3; ++k) crossed[k] = rods.image[i][k] - reference_.image[i][k];
        const Vec3 moved = rods.centre[i] + box.displacement(crossed) - reference_.centre[i];
        return extent_[i] = norm(moved) + 0.5 * rods.length[i] * norm(rods.axis[i] - reference_.axis[i]) + reach[i];
    });
}

void NeighbourList::build(const Rods& rods, const Box& box, double skin) {
    skin_ = skin;
    reference_ = {rods.centre, rods.axis, rods.image};
    double longest = 0.0;
    for (std::size_t i = 0; i < rods.size(); ++i) longest = std::max(longest, rods.length[i] + rods.diameter[i]);
    const CellList cells(rods, box, longest + skin);
    std::vector<std::vector<NeighbourPair>> blocks((rods.size() + rods_per_block - 1) / rods_per_block);
    parallel_for_blocks(rods.size(), rods_per_block, [&](std::size_t block, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) append_pairs_of(i, rods, box, cells, skin, blocks[block]);
    });
    pairs_.clear();
    for (const auto& block : blocks) pairs_.insert(pairs_.end(), block.begin(), block.end());
}

}  // namespace jostle
