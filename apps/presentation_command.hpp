#pragma once

#include <string>
#include <vector>

#include "exit_code.hpp"

/// `jostle export`, `jostle report` and `jostle movie`: hands over to the Python program presentation/PROGRAM.py, whose
/// exit status is that of the command.
///
/// Does not return when the program starts. Errors: InputError if Python or the program is not there.
ExitCode presentation_command(const std::string& program, const std::vector<std::string>& arguments);
