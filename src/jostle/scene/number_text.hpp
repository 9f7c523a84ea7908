#pragma once

#include <fmt/core.h>

#include <array>
#include <string>

#include "jostle/math/vec3.hpp"

// How the checks of a scene write values.

namespace jostle {

/// As the user would write it.
inline std::string text(double value) {
    return fmt::format("{}", value);
}
inline std::string text(const Vec3& value) {
    return fmt::format("[{}, {}, {}]", value.x, value.y, value.z);
}
inline std::string text(const std::array<bool, 3>& value) {
    return fmt::format("[{}, {}, {}]", value[0], value[1], value[2]);
}
/// To four digits.
inline std::string rounded(double value) {
    return fmt::format("{:.4g}", value);
}

}  // namespace jostle
