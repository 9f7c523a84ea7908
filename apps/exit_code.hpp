#pragma once

#include <functional>
#include <string>

/// What the command's exit status means; told in README and `jostle --help`.
enum class ExitCode : int {
    done = 0,
    internal = 1,
    bad_input = 2,
    numerics = 3,        ///< contacts not resolved, or overlap above the limit
    disk = 4,            ///< or standard output cannot be written
    stopped_early = 75,  ///< run again to go on (EX_TEMPFAIL)
};

/// Runs a command, tells any error on standard error in one line, and returns the exit status. A command that is done
/// but whose output did not reach its place ends as after a full disk.
/// `who`: before the message.
int exit_status(const std::function<ExitCode()>& command, const std::string& who = {});
