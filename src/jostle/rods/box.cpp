#include "jostle/rods/box.hpp"

#include <algorithm>
#include <cmath>

namespace jostle {

namespace {

constexpr double farthest_image = 1e9;  ///< images are counted in 32 bits

}  // namespace

Box Box::sheared(double offset) const {
    Box box = *this;
    box.offset_ = std::clamp(std::remainder(offset, edges_.x), -0.5 * edges_.x, 0.5 * edges_.x);
    return box;
}

void Box::wrap(Vec3& centre, Image& image) const {
    for (const int k : {1, 0, 2}) {  // across y first, which may move a centre along x
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
        if (k == 1) centre.x -= count * offset_;
    }
}

}  // namespace jostle
