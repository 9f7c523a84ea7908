#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "exit_code.hpp"
#include "jostle/measurement/measurement.hpp"
#include "jostle/measurement/side_tables.hpp"
#include "jostle/run_files/run_directory.hpp"
#include "jostle/simulation/simulation.hpp"
#include "progress_line.hpp"
#include "run_files.hpp"
#include "run_options.hpp"
#include "run_record.hpp"
#include "run_scene.hpp"
#include "together.hpp"

/// A run from its beginning, or from its checkpoint, to its end. Where several ranks make it, each has one, and goes
/// through it with the others; the first one writes, tells, and decides when it ends.
class Run {
public:
    /// Holds references. `simulation`: with all rods; `measurement`: as it is where that stands. `files` and
    /// `directory`: null for ranks but the first. `start`: how the simulation was made (start_entry); null if the run
    /// goes on.
    Run(const RunOptions& options, const RunScene& scene, jostle::Simulation& simulation,
        jostle::Measurement& measurement, const Together& together, RunFiles* files = nullptr,
        const jostle::RunDirectory* directory = nullptr, nlohmann::ordered_json start = nullptr);

    /// Makes steps, and writes what is due, until the run is over or has to stop.
    ExitCode go();

private:
    /// What all ranks know at the end of a step.
    struct Decision {
        bool is_complete = false, checkpoint_is_overdue = false;
        std::string reason_to_stop = {};  ///< empty: none
    };

    void share();
    bool is_alone();
    void find_thinnest();
    double thinnest() const;
    bool is_first() const { return files_ != nullptr; }
    Decision decide();
    void require_same(const jostle::StepReport& report, const jostle::Due& due);
    void write_what_is_due(const jostle::Due& due, bool checkpoint_is_overdue);
    /// Their slices go to the first rank, or, of very many rods, to all ranks.
    jostle::RodsInOrder rods_for_files() const;
    void append_frame();
    void checkpoint();
    void record(const std::string& exit_reason);
    bool wall_time_is_over(double still_to_be_done) const;
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
    jostle::Ranks ranks_;
    RunFiles* files_;
    jostle::TableColumns<jostle::ContactState> contact_columns_;
    const jostle::RunDirectory* directory_;
    std::optional<RunRecord> record_;
    double volume_fraction_, thinnest_;  ///< of all rods before they are shared, and their smallest diameter
    ProgressLine progress_;
    std::chrono::steady_clock::time_point last_checkpoint_ = std::chrono::steady_clock::now();
    double longest_step_ = 0.0, longest_checkpoint_ = 0.0;  ///< s
};
