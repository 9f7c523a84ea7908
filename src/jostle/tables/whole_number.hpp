#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "jostle/error/input_error.hpp"

namespace jostle {

/// A number of a table as a whole one. Throws InputError, without a place, unless it is whole and a double holds it.
inline std::int64_t whole_number(const char* name, double value) {
    constexpr double largest = 9007199254740992.0;  // 2^53
    if (value == std::floor(value) && std::fabs(value) <= largest) return static_cast<std::int64_t>(value);
    throw InputError({.key = name, .value = fmt::format("{}", value), .problem = "is not a whole number below 2^53"});
}

}  // namespace jostle
