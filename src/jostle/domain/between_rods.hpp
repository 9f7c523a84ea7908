#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "jostle/domain/domain.hpp"

namespace jostle {

/// What lies between two rods each, as springs do: every rank has what its own rods are a part of. Of two ranks that
/// have the same, that of the first rod counts it; if nobody has that rod, the other one.
template <class Item>
struct BetweenRods {
    std::vector<Item> items;  ///< those first that are counted here
    std::size_t counted = 0;
};

/// Brings items to the ranks of their rods. `counted`: those that this rank has counted so far, which others have
/// beside it or have not; ends(item): ids of the two rods. All ranks call it together.
template <class Item, class Ends>
BetweenRods<Item> at_ranks_of_rods(const Domain& domain, const Rods& rods, std::span<const Item> counted, Ends&& ends) {
    const Ranks& ranks = domain.ranks();
    std::vector<std::uint64_t> ids;
    for (const Item& item : counted) {
        const std::array<std::uint64_t, 2> both = ends(item);
        ids.insert(ids.end(), both.begin(), both.end());
    }
    const std::vector<int> rank_of = domain.ranks_of(rods, ids);
    std::vector<std::vector<Item>> to_count(static_cast<std::size_t>(ranks.count())), to_know(to_count.size());
    for (std::size_t k = 0; k < counted.size(); ++k) {
        const int first = rank_of[2 * k], second = rank_of[2 * k + 1];
        const int counting = first != Domain::nobody ? first : second != Domain::nobody ? second : ranks.rank();
        to_count[static_cast<std::size_t>(counting)].push_back(counted[k]);
        if (second != Domain::nobody && second != counting)
            to_know[static_cast<std::size_t>(second)].push_back(counted[k]);
    }
    BetweenRods<Item> here;
    const auto take = [&](const std::vector<std::vector<Item>>& arrived) {
        for (const auto& of_rank : arrived) here.items.insert(here.items.end(), of_rank.begin(), of_rank.end());
    };
    take(ranks.deal(to_count));
    here.counted = here.items.size();
    take(ranks.deal(to_know));
    return here;
}

}  // namespace jostle
