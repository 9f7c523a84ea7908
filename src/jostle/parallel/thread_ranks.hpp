#pragma once

#include <functional>

#include "jostle/parallel/ranks.hpp"

namespace jostle {

/// Calls body(ranks) on `count` threads of this process, each of which is a rank, and waits for all. What a rank throws
/// first ends the others where they wait for it, and is thrown here.
void run_as_ranks(int count, const std::function<void(const Ranks&)>& body);

}  // namespace jostle
