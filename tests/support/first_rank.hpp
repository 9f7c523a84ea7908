#pragma once

#include <utility>

#include "jostle/parallel/thread_ranks.hpp"

namespace jostle::test {

/// All of so many ranks work; what the `work(ranks)` of one returns.
template <class Work>
auto result_of_rank(int rank, int count, Work&& work) {
    decltype(work(std::declval<const Ranks&>())) result{};
    run_as_ranks(count, [&](const Ranks& ranks) {
        auto own = work(ranks);
        if (ranks.rank() == rank) result = std::move(own);
    });
    return result;
}

template <class Work>
auto result_of_first_rank(int count, Work&& work) {
    return result_of_rank(0, count, work);
}

}  // namespace jostle::test
