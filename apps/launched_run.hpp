#pragma once

#include <functional>

#include "exit_code.hpp"
#include "run_options.hpp"
#include "together.hpp"

/// What one process of several that a launcher has started does for `jostle run`: joins the others and, if it is the
/// first, calls first(together), else the same run without files. An error of any ends all, with its message and exit
/// code. Returns the exit code of the first, for all.
ExitCode launched_run(const RunOptions& options, const std::function<ExitCode(Together&)>& first);
