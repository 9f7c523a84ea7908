#pragma once

#include <cstdint>

namespace jostle {

/// Where a simulation stands in time.
struct Clock {
    std::uint64_t step = 0;
    double time = 0.0;
};

inline constexpr std::uint64_t max_steps = 1'000'000'000'000'000;  ///< of a run: counts stay exact as double

}  // namespace jostle
