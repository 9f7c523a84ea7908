#pragma once

#include "exit_code.hpp"
#include "run_options.hpp"

/// `jostle run`: runs a scene, or goes on with a run of it that was stopped or killed.
ExitCode run_command(const RunOptions& options);
