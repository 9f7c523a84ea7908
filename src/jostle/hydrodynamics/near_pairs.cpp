#include "jostle/hydrodynamics/near_pairs.hpp"

#include <algorithm>
#include <tuple>

#include "jostle/contact/neighbour_list.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

void NearPairs::find(const Rods& rods, const Box& box, const RodBlobs& blobs, double cutoff) {
    pairs_.clear();
    if (box.is_periodic())
        find_in_periodic_box(rods, box, blobs, cutoff);
    else
        for (std::uint32_t i = 0; i < rods.size(); ++i)
            for (std::uint32_t j = i + 1; j < rods.size(); ++j)
                pairs_.push_back(in_order_of_ids({i, j, {0, 0, 0}}, rods.id));
    list_sides(rods);
}

void NearPairs::find_in_periodic_box(const Rods& rods, const Box& box, const RodBlobs& blobs, double cutoff) {
    std::vector<double> range(rods.size());  // of the rods' surfaces, in which blobs come nearer than the cutoff
    parallel_for(range.size(), [&](std::size_t i) {
        const double beyond_end = std::max(0.0, blobs.of(i).half() - 0.5 * rods.length[i]);
        range[i] = std::max(0.0, 0.5 * (cutoff - rods.diameter[i]) + beyond_end);
    });
    NeighbourList neighbours(0.0);
    neighbours.update(rods, box, range);
    std::vector<std::vector<PairKey>> found(neighbours.block_count());
    parallel_for_parts(found.size(), [&](std::size_t block) {
        neighbours.for_close_pairs(block, [&](std::uint32_t i, std::size_t pair) {
            found[block].push_back(in_order_of_ids(neighbours.key(i, pair), rods.id));
        });
    });
    for (const auto& part : found) pairs_.insert(pairs_.end(), part.begin(), part.end());
}

void NearPairs::list_sides(const Rods& rods) {
    begin_.assign(rods.size() + 1, 0);
    sides_.resize(2 * pairs_.size());
    for (const PairKey& pair : pairs_) {
        ++begin_[pair.i + 1];
        ++begin_[pair.j + 1];
    }
    for (std::size_t i = 0; i < rods.size(); ++i) begin_[i + 1] += begin_[i];
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
        sides_[next[pairs_[p].i]++] = static_cast<std::uint32_t>(2 * p);
        sides_[next[pairs_[p].j]++] = static_cast<std::uint32_t>(2 * p + 1);
    }
    const auto order = [&](std::uint32_t side) {
        const PairKey& pair = pairs_[side / 2];
        return side % 2 == 0 ? std::tuple(rods.id[pair.j], pair.image)
                             : std::tuple(rods.id[pair.i], pair.turned().image);
    };
    parallel_for(rods.size(), [&](std::size_t i) {
        std::sort(sides_.begin() + static_cast<std::ptrdiff_t>(begin_[i]),
                  sides_.begin() + static_cast<std::ptrdiff_t>(begin_[i + 1]),
                  [&](std::uint32_t a, std::uint32_t b) { return order(a) < order(b); });
    });
    others_.resize(sides_.size());
    parallel_for(others_.size(), [&](std::size_t entry) {
        const PairKey& pair = pairs_[sides_[entry] / 2];
        others_[entry] = sides_[entry] % 2 == 0 ? pair.j : pair.i;
    });
}

}  // namespace jostle
