#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "jostle/parallel/ranks.hpp"

namespace jostle {

/// Where that is kept which has to be found by the id of a rod, whichever rank has the rod now: every rank keeps what
/// belongs to ids of one range, rank after rank.
class Homes {
public:
    /// Ids are below `ids`.
    Homes(const Ranks& ranks, std::uint64_t ids)
        : ranks_(ranks), ids_(ids), range_(std::max<std::uint64_t>(1, (ids + count() - 1) / count())) {}

    int rank_of(std::uint64_t id) const { return static_cast<int>(std::min(id / range_, count() - 1)); }
    /// The first id that is at home here, and the first beyond.
    std::pair<std::uint64_t, std::uint64_t> range() const {
        const auto rank = static_cast<std::uint64_t>(ranks_.rank());
        const std::uint64_t begin = std::min(rank * range_, ids_);
        return {begin, rank + 1 == count() ? ids_ : std::min(begin + range_, ids_)};
    }

    /// Brings each item to the home of its `id`; returns those that are at home here, in any order. All ranks call it
    /// together.
    template <class Item>
    std::vector<Item> bring(std::span<const Item> items) const {
        std::vector<std::vector<Item>> to(count());
        for (const Item& item : items) to[static_cast<std::size_t>(rank_of(item.id))].push_back(item);
        std::vector<Item> here;
        for (const auto& arrived : ranks_.deal(to)) here.insert(here.end(), arrived.begin(), arrived.end());
        return here;
    }

private:
    std::uint64_t count() const { return static_cast<std::uint64_t>(ranks_.count()); }

    Ranks ranks_;
    std::uint64_t ids_, range_;
};

}  // namespace jostle
