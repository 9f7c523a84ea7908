#pragma once

#include <utility>

#include "jostle/parallel/thread_ranks.hpp"

namespace jostle::test {

/// All of so many ranks work; what the first one's `work(ranks)` returns.
template <class Work>
auto result_of_first_rank(int count, Work&& work) {
    decltype(work(std::declval<const Ranks&>())) result{};
    run_as_ranks(count, [&](const Ranks& ranks) {
        auto own = work(ranks);
        if (ranks.rank() == 0) result = std::move(own);
    });
    return result;
}

}  // namespace jostle::test
