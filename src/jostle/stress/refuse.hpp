#pragma once

#include <string>
#include <utility>

#include "jostle/error/input_error.hpp"

namespace jostle {

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
