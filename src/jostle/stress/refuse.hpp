#pragma once

#include <string>
#include <utility>

#include "jostle/error/input_error.hpp"

namespace jostle {

/// Whether it is a size that a body may have: its powers, up to the fifth, stay within the range of doubles.
inline bool is_size(double length) {
    return length >= 1e-30 && length <= 1e30;
}

/// Throws InputError: what a body or a list of contacts cannot be.
[[noreturn]] inline void refuse(std::string key, std::string value, std::string problem, std::string allowed) {
    throw InputError({.key = std::move(key),
                      .value = std::move(value),
                      .problem = std::move(problem),
                      .allowed = std::move(allowed),
                      .suggestion = "",
                      .place = {}});
}

}  // namespace jostle
