#pragma once

#include <cstdint>

namespace jostle {

/// Spreads the bits of a number over all of it, one to one: a hash of whole numbers, with no randomness asked of it.
constexpr std::uint64_t mixed_bits(std::uint64_t x) {
    x = (x ^ x >> 32) * 0xD6E8FEB86659FD93;
    x = (x ^ x >> 32) * 0xD6E8FEB86659FD93;
    return x ^ x >> 32;
}

}  // namespace jostle
