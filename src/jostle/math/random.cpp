#include "jostle/math/random.hpp"

#include <Random123/philox.h>

#include <cmath>
#include <numbers>

namespace jostle {

namespace {

/// Counter layout (128 bits): id, 64 | step, 40 low bits | stream, 4 | draw, 20. Steps beyond 2^40 would take
/// centuries.
std::array<std::uint32_t, 4> philox(const RandomKey& key, std::uint32_t draw) {
    using Generator = r123::Philox4x32;
    const auto low = [](std::uint64_t word) { return static_cast<std::uint32_t>(word); };
    const auto high = [](std::uint64_t word) { return static_cast<std::uint32_t>(word >> 32); };
    const std::uint32_t purpose = (static_cast<std::uint32_t>(key.stream) & 0xFU) << 20 | (draw & 0xFFFFFU);
    const Generator::ctr_type counter = {
        {low(key.id), high(key.id), low(key.step), (high(key.step) & 0xFFU) << 24 | purpose}};
    const Generator::key_type philox_key = {{low(key.seed), high(key.seed)}};
    const Generator::ctr_type words = Generator()(counter, philox_key);
    return {words[0], words[1], words[2], words[3]};
}

double open_unit_interval(std::uint32_t word) {
    return (static_cast<double>(word) + 0.5) * 0x1p-32;
}

}  // namespace

std::array<double, 4> uniform4(const RandomKey& key, std::uint32_t draw) {
    const auto words = philox(key, draw);
    return {open_unit_interval(words[0]), open_unit_interval(words[1]), open_unit_interval(words[2]),
            open_unit_interval(words[3])};
}

std::array<double, 6> normal6(const RandomKey& key) {
    const auto a = philox(key, 0), b = philox(key, 1);
    const std::array<std::uint32_t, 6> words = {a[0], a[1], a[2], a[3], b[0], b[1]};
    std::array<double, 6> normals{};
    for (std::size_t k = 0; k < 6; k += 2) {
        const double radius = std::sqrt(-2.0 * std::log(open_unit_interval(words[k])));
        const double angle = 2.0 * std::numbers::pi * open_unit_interval(words[k + 1]);
        normals[k] = radius * std::cos(angle);
        normals[k + 1] = radius * std::sin(angle);
    }
    return normals;
}

}  // namespace jostle
