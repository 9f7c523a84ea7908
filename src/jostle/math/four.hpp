#pragma once

#include <cstdint>

namespace jostle {

/// Four floats in a vector register of every processor, so that all instruction sets do the same operations.
using Four [[gnu::vector_size(16)]] = float;
/// Four integers; of a comparison -1 where it holds and 0 elsewhere.
using FourIntegers [[gnu::vector_size(16)]] = std::int32_t;

/// value in all lanes.
inline Four four(double value) {
    return static_cast<float>(value) - Four{};
}

inline bool any(const FourIntegers& where) {
    using Two [[gnu::vector_size(16)]] = std::int64_t;
    const auto halves = reinterpret_cast<Two>(where);
    return (halves[0] | halves[1]) != 0;
}

/// values where the comparison holds, 0 elsewhere.
inline Four where(const FourIntegers& holds, const Four& values) {
    return reinterpret_cast<Four>(holds & reinterpret_cast<FourIntegers>(values));
}

/// Of a matrix of four rows.
inline void transpose(Four& a, Four& b, Four& c, Four& d) {
    const Four ab = __builtin_shufflevector(a, b, 0, 4, 1, 5), cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
    const Four ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7), cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    a = __builtin_shufflevector(ab, cd, 0, 1, 4, 5);
    b = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
    c = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
    d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

/// The sums over the lanes of each.
inline Four sums(Four a, Four b, Four c, Four d) {
    transpose(a, b, c, d);
    return (a + b) + (c + d);
}

}  // namespace jostle
