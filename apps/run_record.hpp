#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "jostle/run_files/run_directory.hpp"
#include "jostle/simulation/simulation.hpp"
#include "run_options.hpp"
#include "together.hpp"

/// run.json: with what, where and for how long a run was made; one entry a session in "sessions".
class RunRecord {
public:
    /// Holds the reference. Sessions that the run.json of the folder already tells are kept, and its start, where
    /// `start` is null.
    RunRecord(const jostle::RunDirectory& directory, const RunOptions& options, const Together& together,
              nlohmann::ordered_json start);

    /// Writes the record with what this session has come to. `exit_reason`: "running", "done", "signal 15", ...
    void write(const jostle::Simulation& simulation, const std::string& exit_reason);

private:
    const jostle::RunDirectory& directory_;
    nlohmann::ordered_json earlier_sessions_;  ///< array
    nlohmann::ordered_json start_;             ///< how the run started; null where an earlier record of it is lost
    std::string command_line_;
    int ranks_;
    std::vector<std::string> hosts_;  ///< of them, if they are several
    std::string started_;
    double began_ = 0.0;
    std::uint64_t first_step_ = 0;
    bool begun_ = false;
};

/// Name of this machine.
std::string host_name();
