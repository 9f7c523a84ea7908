#pragma once

#include <string>
#include <vector>

#include "exit_code.hpp"

/// Hands over to a Python program of presentation/ or sweeps/, named as "sweeps/sweep", with these arguments. Returns
/// only by throwing InputError: if it, or Python, is not there.
[[noreturn]] ExitCode python_program(const std::string& program, const std::vector<std::string>& arguments);

/// Where this very program lies.
std::string path_of_command();
