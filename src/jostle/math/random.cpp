#include "jostle/math/random.hpp"

#include <Random123/philox.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>

#include "jostle/math/vectorised.hpp"

namespace jostle {

namespace {

using Generator = r123::Philox4x32;

/// Counter layout (128 bits): id, 64 | step, 40 low bits | stream, 4 | draw, 20. Steps beyond 2^40 would take
/// centuries.
Generator::ctr_type counter_of(const RandomKey& key, std::uint32_t draw) {
    const auto low = [](std::uint64_t word) { return static_cast<std::uint32_t>(word); };
    const auto high = [](std::uint64_t word) { return static_cast<std::uint32_t>(word >> 32); };
    const std::uint32_t purpose = (static_cast<std::uint32_t>(key.stream) & 0xFU) << 20 | (draw & 0xFFFFFU);
    return {{low(key.id), high(key.id), low(key.step), (high(key.step) & 0xFFU) << 24 | purpose}};
}

Generator::key_type philox_key(const RandomKey& key) {
    return {{static_cast<std::uint32_t>(key.seed), static_cast<std::uint32_t>(key.seed >> 32)}};
}

inline double open_unit_interval(std::uint32_t word) {
    return (static_cast<double>(word) + 0.5) * 0x1p-32;
}

// The functions below work on many ids at once: plain loops without calls or jumps, which compilers turn into vector
// instructions. That is why they do not use std::log, std::sin and std::cos, which also differ from library to library.

constexpr std::size_t batch = 64;
using Words = std::array<std::array<std::uint32_t, batch>, 4>;
using Row = std::array<double, batch>;

JOSTLE_VECTORISED void fill_words(const std::uint64_t* ids, const Generator::ctr_type& shared,
                                  const Generator::key_type& key, Words& words) {
    for (std::size_t k = 0; k < batch; ++k) {
        const Generator::ctr_type counter = {
            {static_cast<std::uint32_t>(ids[k]), static_cast<std::uint32_t>(ids[k] >> 32), shared[2], shared[3]}};
        const Generator::ctr_type drawn = Generator()(counter, key);
        words[0][k] = drawn[0];
        words[1][k] = drawn[1];
        words[2][k] = drawn[2];
        words[3][k] = drawn[3];
    }
}

/// ln u for 0 < u < 1: u = 2^exponent m with m in [sqrt(1/2), sqrt(2)), ln m = 2 artanh((m - 1)/(m + 1)), its series to
/// the 19th power.
inline double logarithm(double u) {
    const auto bits = std::bit_cast<std::uint64_t>(u);
    const std::uint64_t root_of_half = 0x3FE6A09E667F3BCDULL;
    const auto exponent = static_cast<std::int32_t>(static_cast<std::int64_t>(bits - root_of_half) >> 52);
    const double m = std::bit_cast<double>(bits - (static_cast<std::uint64_t>(std::int64_t{exponent}) << 52));
    const double s = (m - 1.0) / (m + 1.0);
    const double z = s * s;
    double series = 2.0 / 19.0;
    series = series * z + 2.0 / 17.0;
    series = series * z + 2.0 / 15.0;
    series = series * z + 2.0 / 13.0;
    series = series * z + 2.0 / 11.0;
    series = series * z + 2.0 / 9.0;
    series = series * z + 2.0 / 7.0;
    series = series * z + 2.0 / 5.0;
    series = series * z + 2.0 / 3.0;
    series = series * z + 2.0;
    return static_cast<double>(exponent) * std::numbers::ln2 + s * series;
}

/// Taylor series for |x| <= pi/4.
inline double sine(double x) {
    const double y = x * x;
    double series = -1.0 / 1307674368000.0;
    series = series * y + 1.0 / 6227020800.0;
    series = series * y - 1.0 / 39916800.0;
    series = series * y + 1.0 / 362880.0;
    series = series * y - 1.0 / 5040.0;
    series = series * y + 1.0 / 120.0;
    series = series * y - 1.0 / 6.0;
    return x + x * y * series;
}
inline double cosine(double x) {
    const double y = x * x;
    double series = 1.0 / 20922789888000.0;
    series = series * y - 1.0 / 87178291200.0;
    series = series * y + 1.0 / 479001600.0;
    series = series * y - 1.0 / 3628800.0;
    series = series * y + 1.0 / 40320.0;
    series = series * y - 1.0 / 720.0;
    series = series * y + 1.0 / 24.0;
    return 1.0 - 0.5 * y + y * y * series;
}

/// Box-Muller: radius sqrt(-2 ln u) from one word, the angle from the other. The angle's word, as a fraction of a turn,
/// is split into the nearest quarter turn and a rest of at most an eighth.
JOSTLE_VECTORISED void box_muller(const std::uint32_t* radius_words, const std::uint32_t* angle_words, double* first,
                                  double* second) {
    for (std::size_t k = 0; k < batch; ++k) {
        const double radius = std::sqrt(-2.0 * logarithm(open_unit_interval(radius_words[k])));
        const std::uint32_t word = angle_words[k];
        const std::uint32_t quarter = (word + 0x20000000U) >> 30;
        const auto rest = static_cast<std::int32_t>(word << 2);
        const double angle = (static_cast<double>(rest) + 2.0) * (0x1p-33 * std::numbers::pi);
        const double s = sine(angle), c = cosine(angle);
        const double x = (quarter & 1U) != 0 ? s : c, y = (quarter & 1U) != 0 ? c : s;
        const double x_radius = ((quarter + 1U) & 2U) != 0 ? -radius : radius;
        const double y_radius = (quarter & 2U) != 0 ? -radius : radius;
        first[k] = x_radius * x;
        second[k] = y_radius * y;
    }
}

}  // namespace

std::array<double, 4> uniform4(const RandomKey& key, std::uint32_t draw) {
    const Generator::ctr_type words = Generator()(counter_of(key, draw), philox_key(key));
    return {open_unit_interval(words[0]), open_unit_interval(words[1]), open_unit_interval(words[2]),
            open_unit_interval(words[3])};
}

bool happens(const RandomKey& key, double probability) {
    const Generator::ctr_type words = Generator()(counter_of(key, 0), philox_key(key));
    // One of 2^64 numbers in (0, 1), of which a double keeps 53 bits.
    const double uniform = (static_cast<double>(words[0]) + (static_cast<double>(words[1]) + 0.5) * 0x1p-32) * 0x1p-32;
    return uniform < probability;
}

double exponential(double uniform) {
    return -logarithm(uniform);
}

void fill_normals(const RandomKey& key, std::span<const std::uint64_t> ids, std::span<Normals> normals) {
    assert(ids.size() == normals.size());
    std::array<std::uint64_t, batch> these{};
    Words a, b;
    std::array<Row, 6> rows;
    for (std::size_t begin = 0; begin < ids.size(); begin += batch) {
        const std::size_t count = std::min(batch, ids.size() - begin);
        std::copy_n(ids.data() + begin, count, these.data());
        fill_words(these.data(), counter_of(key, 0), philox_key(key), a);
        fill_words(these.data(), counter_of(key, 1), philox_key(key), b);
        box_muller(a[0].data(), a[1].data(), rows[0].data(), rows[1].data());
        box_muller(a[2].data(), a[3].data(), rows[2].data(), rows[3].data());
        box_muller(b[0].data(), b[1].data(), rows[4].data(), rows[5].data());
        for (std::size_t k = 0; k < count; ++k)
            normals[begin + k] = {rows[0][k], rows[1][k], rows[2][k], rows[3][k], rows[4][k], rows[5][k]};
    }
}

}  // namespace jostle
