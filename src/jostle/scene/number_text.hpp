#pragma once

#include <fmt/core.h>

#include <string>

#include "jostle/math/vec3.hpp"

// How the checks of a scene write numbers.

namespace jostle {

/// As the user would write it.
inline std::string text(double value) {
    return fmt::format("{}", value);
}
inline std::string text(const Vec3& value) {
    return fmt::format("[{}, {}, {}]", value.x, value.y, value.z);
}
/// To four digits.
inline std::string rounded(double value) {
    return fmt::format("{:.4g}", value);
}

}  // namespace jostle
