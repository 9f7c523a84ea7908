#pragma once

#include <chrono>
#include <string>

#include "exit_code.hpp"
#include "jostle/measurement/measurement.hpp"
#include "jostle/run_files/run_directory.hpp"
#include "jostle/simulation/simulation.hpp"
#include "progress_line.hpp"
#include "run_files.hpp"
#include "run_options.hpp"
#include "run_record.hpp"
#include "run_scene.hpp"

/// A run from its beginning, or from its checkpoint, to its end.
class Run {
public:
    /// Holds references. `measurement`: as it is where `simulation` stands. `start`: how that was made (start_entry);
    /// null if the run goes on.
    Run(const RunOptions& options, const RunScene& scene, jostle::Simulation& simulation,
        jostle::Measurement& measurement, RunFiles& files, const jostle::RunDirectory& directory,
        nlohmann::ordered_json start = nullptr);

    /// Makes steps, and writes what is due, until the run is over or has to stop.
    ExitCode go();

private:
    void write_what_is_due(const jostle::Due& due);
    void checkpoint();
    bool wall_time_is_over(double still_to_be_done) const;
    std::string reason_to_stop() const;
    void show_progress(const std::string& remark = {});
    void write_trajectory() const;
    std::string files_and_report() const;
    ExitCode stop_early(const std::string& reason);
    ExitCode die_out();
    ExitCode give_up(const jostle::StepReport& report, const std::string& failure, const std::string& advice);
    ExitCode finish();

    const RunOptions& options_;
    const RunScene& run_scene_;
    const jostle::Scene& scene_;
    jostle::Simulation& simulation_;
    jostle::Measurement& measurement_;
    RunFiles& files_;
    const jostle::RunDirectory& directory_;
    RunRecord record_;
    ProgressLine progress_;
    std::chrono::steady_clock::time_point last_checkpoint_ = std::chrono::steady_clock::now();
    double longest_step_ = 0.0, longest_checkpoint_ = 0.0;  ///< s
};
