#pragma once

#include <string>
#include <vector>

#include "exit_code.hpp"

/// `jostle check`: reads and validates a scene, and prints what it means: the resolved scene, derived numbers, memory
/// and time.
ExitCode check_command(const std::string& scene_path, const std::vector<std::string>& set = {});
