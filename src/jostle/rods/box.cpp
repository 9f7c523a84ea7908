#include "jostle/rods/box.hpp"

#include <algorithm>
#include <cmath>

namespace jostle {

namespace {

constexpr double farthest_image = 1e9;  ///< images are counted in 32 bits

}  // namespace

void Box::wrap(Vec3& centre, Image& image) const {
    for (int k = 0; k < 3; ++k) {
        const auto direction = static_cast<std::size_t>(k);
        if (!periodic_[direction] || (centre[k] >= 0.0 && centre[k] < edges_[k])) continue;
        const double crossed = std::floor(centre[k] / edges_[k]);
        double wrapped = centre[k] - crossed * edges_[k];
        auto count = static_cast<std::int32_t>(std::clamp(crossed, -farthest_image, farthest_image));
        if (wrapped < 0.0) wrapped = 0.0;  // rounding
        if (wrapped >= edges_[k]) {        // rounding: a hair below 0 becomes the edge itself
            wrapped = 0.0;
            ++count;
        }
        centre[k] = wrapped;
        image[direction] += count;
    }
}

}  // namespace jostle
