#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace jostle {

/// Streams keep the random numbers of different purposes independent of one another.
enum class Stream : std::uint32_t {
    brownian = 1,
    start = 2,
    test = 3,
    growth = 4,
    death = 5,
    rod_size = 6,
    swimming_speed = 8,
    reversal = 9,
    tumble_time = 10,
    tumble_rotation = 11,
    monte_carlo = 12,
    fluid = 13,
    box = 14  // at most 15
};

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

/// Whether an event of this probability happens: draw 0 of the key. Right for any probability, also far below 2^-32.
bool happens(const RandomKey& key, double probability);

/// A number of the exponential distribution with mean 1, at most 22.9, from a uniform one: the time between two events
/// of a Poisson process of rate 1.
double exponential(double uniform);

/// Six independent standard normal numbers: one rod's noise in a step.
using Normals = std::array<double, 6>;

/// So many rods' are best drawn at once: fewer waste vector instructions, more leave the nearest cache.
inline constexpr std::size_t normals_at_a_time = 256;

/// The normal numbers of (seed, step, stream) and each of `ids`, which stand in for the key's own: draw 0, and half of
/// draw 1.
///
/// Box-Muller, right to 3e-15; the largest possible magnitude is 6.7. `normals` has one place an id. The numbers of an
/// id do not depend on the others.
void fill_normals(const RandomKey& key, std::span<const std::uint64_t> ids, std::span<Normals> normals);

}  // namespace jostle
