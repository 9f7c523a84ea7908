#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

/// What the command line of `jostle run` says.
struct RunOptions {
    std::string scene;                     ///< path of the scene file
    std::vector<std::string> settings;     ///< --set KEY=VALUE, in the place of what the scene says
    std::string folder;                    ///< --out; empty: the scene's name, in the current folder
    std::optional<long long> threads;      ///< empty: as many as are worth starting (parallel::suit_thread_count)
    std::size_t colours_per_exchange = 0;  ///< Simulation::exchange_once_in
    double ranks_write_above = 1e8;        ///< every rank writes its part of the files of more rods
    std::optional<double> wall_time;       ///< seconds; stop before it is over
    bool alone = false;                    ///< one process makes the run, whatever has started it
    bool fresh = false;                    ///< move an existing run aside, and start anew
    bool quiet = false;
    bool json = false;  ///< print the summary as JSON, and nothing else
    std::chrono::steady_clock::time_point began = std::chrono::steady_clock::now();  ///< wall time counts from here
    std::string command_line;                                                        ///< as typed
};
