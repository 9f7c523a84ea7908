#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <vector>

#include "exit_code.hpp"

/// A command of jostle: the words that it reads, and what it does with them.
struct Command {
    CLI::App* words;
    std::function<ExitCode()> carry_out;
    std::function<void()> begin = [] {};  ///< before it, while signals wait
};

/// All of them, added to `app`. `argc`, `argv`: of main.
std::vector<Command> add_commands(CLI::App& app, int argc, char** argv);
