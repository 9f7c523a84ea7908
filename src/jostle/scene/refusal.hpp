#pragma once

#include <fmt/core.h>

#include <string>
#include <utility>

#include "jostle/error/input_error.hpp"
#include "jostle/math/vec3.hpp"

// How the checks of a scene word what they refuse.

namespace jostle {

/// Throws InputError of these parts; the place is not known here.
[[noreturn]] inline void refuse(std::string key, std::string value, std::string problem, std::string allowed,
                                std::string suggestion) {
    throw InputError(
        {std::move(key), std::move(value), std::move(problem), std::move(allowed), std::move(suggestion), {}});
}

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
