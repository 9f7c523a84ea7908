#pragma once

#include <array>
#include <cstdint>

namespace jostle {

/// Streams keep the random numbers of different purposes independent of one another.
enum class Stream : std::uint32_t { brownian = 1, start = 2, test = 3 };

/// Random numbers as a pure function of (seed, step, stream, id, draw): Philox4x32-10 (Salmon et al. 2011).
///
/// No state: the same arguments give the same numbers on any thread, in any order, after any restart.
/// Different draws of one (seed, step, stream, id) are independent. `draw` < 2^20, `step` < 2^40.
struct RandomKey {
    std::uint64_t seed = 0;
    std::uint64_t step = 0;
    Stream stream = Stream::test;
    std::uint64_t id = 0;
};

/// Four independent uniform numbers in the open interval (0, 1), spaced by 2^-32.
std::array<double, 4> uniform4(const RandomKey& key, std::uint32_t draw);

/// Six independent standard normal numbers (Box-Muller; the largest possible magnitude is 6.7): one rod's noise in a
/// step.
std::array<double, 6> normal6(const RandomKey& key);

}  // namespace jostle
