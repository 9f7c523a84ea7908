#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "jostle/measurement/side_tables.hpp"
#include "jostle/measurement/step_sums.hpp"
#include "jostle/run_files/checkpoint.hpp"
#include "jostle/run_files/run_directory.hpp"
#include "jostle/run_files/series_file.hpp"
#include "jostle/run_files/trajectory_journal.hpp"
#include "jostle/scene/scene.hpp"
#include "jostle/simulation/simulation.hpp"

/// A table that a run of a scene writes, NAME.csv, and what its columns are, which stands in NAME.json.
struct DescribedTable {
    std::string name;
    std::vector<jostle::SeriesColumn> columns;
};

/// All of them, the series first.
std::vector<DescribedTable> described_tables(const jostle::Scene& scene);

/// The stress of every rod (N) in the last step, in the order of ids, for the first rank; all call it together. Not a
/// number for a rod that was not in that step.
std::vector<jostle::Mat3> stress_of_last_step(const jostle::Simulation& simulation, const jostle::RodsInOrder& rods);

/// The files that grow while a run lasts, kept in step with its checkpoints.
///
/// Resuming cuts all of them back to the checkpoint, so that the steps made since are made, and written, again.
class RunFiles {
public:
    /// Files of a new run; `simulation` stands at its beginning.
    RunFiles(const jostle::RunDirectory& directory, const jostle::Scene& scene, const std::string& resolved_scene,
             const jostle::Simulation& simulation, const jostle::StepSums& sums);
    /// Files of a run that goes on from a checkpoint, where `simulation` stands. Nothing is cut before all files were
    /// found to be sound.
    RunFiles(const jostle::RunDirectory& directory, const jostle::Scene& scene, const jostle::Simulation& simulation,
             const jostle::FilePositions& positions);

    void append_row(const std::vector<double>& row);
    /// `stress`: that of the last step, if it is asked for. The other ranks send their rods.
    void append_frame(const jostle::Simulation& simulation, const jostle::RodsInOrder& rods,
                      const std::vector<jostle::Mat3>& stress);
    void append_contacts(const jostle::TableRows& rows);
    void append_field(const jostle::TableRows& rows);
    /// Who was born and who died after the last step.
    void append_lineage(const jostle::Simulation& simulation);

    /// Makes everything so far durable, and the point to go on from. The other ranks send their rods.
    void write_checkpoint(jostle::Checkpoint checkpoint, const jostle::RodsInOrder& rods);

    bool has_trajectory() const { return journal_.has_value(); }

private:
    void open_others(const jostle::Simulation& simulation, const jostle::FilePositions& positions);
    void append_first_frame(const jostle::Simulation& simulation);
    void append(std::size_t table, const jostle::TableRows& rows);

    const jostle::RunDirectory& directory_;
    const jostle::Scene& scene_;
    jostle::SeriesFile series_file_;
    std::optional<jostle::TrajectoryJournal> journal_;
    std::array<std::optional<jostle::SeriesFile>, 3> side_files_;  ///< contacts, lineage, field
    jostle::TableColumns<jostle::LineageState> lineage_columns_;
};
