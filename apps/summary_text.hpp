#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "jostle/scene/scene.hpp"

/// The summary of a run of the scene as a few lines to read.
std::string summary_text(const nlohmann::ordered_json& summary, const jostle::Scene& scene);
