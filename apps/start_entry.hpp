#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "jostle/scene_file/rods_of_scene.hpp"

/// What run.json says of a start: its kind, how it was annealed, and "in_words" for people.
nlohmann::ordered_json start_entry(const jostle::Scene& scene, const jostle::Beginning& beginning);

/// The same in lines for a terminal: how the rods were annealed, where they were, in how many seconds; and the warning,
/// if any.
std::string start_text(const nlohmann::ordered_json& entry, double seconds);
