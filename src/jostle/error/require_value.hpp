#pragma once

#include <sstream>

#include "jostle/error/input_error.hpp"

namespace jostle {

/// Throws InputError, with the value as text, unless `good`: the check of a number that something is made with.
inline void require_value(bool good, const char* key, double value, const char* problem, const char* allowed) {
    if (good) return;
    std::ostringstream text;
    text << value;
    throw InputError(
        {.key = key, .value = text.str(), .problem = problem, .allowed = allowed, .suggestion = {}, .place = {}});
}

}  // namespace jostle
