#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "exit_code.hpp"

/// What stands on the command line of `jostle sweep`, `collect` and `extrapolate`; the programs in sweeps/ look at it.
struct SweepOptions {
    std::string scene, out, replicas, processes, against, rms_steps;
    std::vector<std::string> settings, plots, folders;
    bool zip = false, print_commands = false;
};

CLI::App* add_sweep_command(CLI::App& app, SweepOptions& options);
CLI::App* add_collect_command(CLI::App& app, SweepOptions& options);
CLI::App* add_extrapolate_command(CLI::App& app, SweepOptions& options);

/// Hands over to sweeps/COMMAND.py. `typed`: how the user called jostle.
ExitCode sweep_command(const std::string& command, const SweepOptions& options, const std::string& typed);
