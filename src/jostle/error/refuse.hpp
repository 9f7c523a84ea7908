#pragma once

#include <sstream>
#include <string>
#include <utility>

#include "jostle/error/input_error.hpp"

namespace jostle {

/// Throws InputError of these parts. The place is added where it is known, by the reader of the file.
[[noreturn]] inline void refuse(std::string key, std::string value, std::string problem, std::string allowed,
                                std::string suggestion = {}) {
    throw InputError(
        {std::move(key), std::move(value), std::move(problem), std::move(allowed), std::move(suggestion), {}});
}

/// Refuses `value` unless `good`: the check of a number that something is made with.
inline void require_value(bool good, const char* key, double value, const char* problem, const char* allowed) {
    if (good) return;
    std::ostringstream text;
    text << value;
    refuse(key, text.str(), problem, allowed);
}

}  // namespace jostle
