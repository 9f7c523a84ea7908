#pragma once

#include <random>

#include "jostle/rods/rods.hpp"

/// `count` rods whose numbers follow from `seed`, in the unit box, ids 100 apart.
inline jostle::Rods some_rods(std::size_t count, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    jostle::Rods rods;
    for (std::size_t i = 0; i < count; ++i) {
        const jostle::Vec3 centre{uniform(random), uniform(random), uniform(random)};
        const jostle::Vec3 axis{uniform(random), uniform(random), uniform(random) + 0.1};
        rods.push_back(100 * i + seed, centre, jostle::normalised(axis), 5 * uniform(random), 1 + uniform(random));
        rods.image.back() = {static_cast<std::int32_t>(i), -1, static_cast<std::int32_t>(seed)};
    }
    return rods;
}
