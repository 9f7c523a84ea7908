#pragma once

#include <string>

#include "exit_code.hpp"

/// `jostle verify DIR`: reads the files of a run through, and checks every checksum. Changes nothing.
ExitCode verify_command(const std::string& folder);
