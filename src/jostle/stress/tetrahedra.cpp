#include "jostle/stress/tetrahedra.hpp"

#include <fmt/format.h>

#include "jostle/error/input_error.hpp"

namespace jostle {

Vec3 middle_of(const char* key, std::span<const Vec3> points) {
    Vec3 sum;
    for (std::size_t k = 0; k < points.size(); ++k) {
        if (!is_finite(points[k]))
            throw InputError({.key = fmt::format("{}[{}]", key, k),
                              .value = fmt::format("{} {} {}", points[k].x, points[k].y, points[k].z),
                              .problem = "is not finite"});
        sum += points[k];
    }
    if (points.empty()) throw InputError({.key = key, .problem = "there are none"});
    return sum / static_cast<double>(points.size());
}

}  // namespace jostle
