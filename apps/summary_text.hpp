#pragma once

#include <nlohmann/json.hpp>
#include <string>

/// The summary as a few lines to read.
std::string summary_text(const nlohmann::ordered_json& summary);
