#pragma once

#include <nlohmann/json.hpp>
#include <string>

/// A JSON text, read; `is_discarded()` if it is none. What is nested deeper than in any file of jostle is left out, so
/// that no text can exhaust the stack.
nlohmann::ordered_json parsed_json(const std::string& text);
