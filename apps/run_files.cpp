#include "run_files.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "jostle/disk/durable_file.hpp"
#include "jostle/measurement/frame_steps.hpp"
#include "jostle/measurement/series_columns.hpp"
#include "jostle/rods/space_filling_order.hpp"
#include "jostle/stress/stress_per_rod.hpp"

using namespace jostle;

namespace {

/// Tables beside the series.
struct SideTable {
    std::string name;
    bool wanted;
    std::vector<SeriesColumn> columns;
    std::uint64_t Checkpoint::*bytes;
    std::uint64_t Checkpoint::*hash;
};

enum : std::size_t { contacts_table, lineage_table, field_table };

std::array<SideTable, 3> side_tables(const Scene& scene) {
    return {{{"contacts", scene.output.contacts, contact_columns(scene).about(), &Checkpoint::contacts_bytes,
              &Checkpoint::contacts_hash},
             {"lineage", scene.growth.rate > 0.0, lineage_columns(scene).about(), &Checkpoint::lineage_bytes,
              &Checkpoint::lineage_hash},
             {"field", scene.output.field_every > 0, field_columns(scene).about(), &Checkpoint::field_bytes,
              &Checkpoint::field_hash}}};
}

/// The series, cut back to the checkpoint, after all files of the run were found to be sound.
SeriesFile resumed_series(const RunDirectory& directory, const Scene& scene, const Checkpoint& checkpoint) {
    if (keeps_frames(scene))
        TrajectoryJournal::require_frames(directory.file("trajectory.journal"), checkpoint.trajectory_bytes,
                                          checkpoint.trajectory_hash);
    for (const SideTable& table : side_tables(scene))
        if (table.wanted)
            SeriesFile::require_prefix(directory.file(table.name + ".csv"), table.columns, checkpoint.*table.bytes,
                                       checkpoint.*table.hash);
    return SeriesFile::resume(directory.file("series.csv"), series_columns(scene).about(), checkpoint.series_bytes,
                              checkpoint.series_hash);
}

/// The stress of every rod (N) in the last step; not a number for a rod that was not in it.
std::vector<Mat3> stress_of_last_step(const Simulation& simulation, const std::vector<std::uint64_t>& ids) {
    const Mat3 unknown = std::numeric_limits<double>::quiet_NaN() * Mat3{{1, 1, 1, 1, 1, 1, 1, 1, 1}};
    if (simulation.clock().step == 0) return std::vector<Mat3>(ids.size(), unknown);
    std::vector<Mat3> stress = stress_per_rod(simulation.collision_moments(), ids);
    for (const LineageEvent& event : simulation.lineage()) {
        const auto found = std::lower_bound(ids.begin(), ids.end(), event.id);
        if (event.kind == LineageEvent::Kind::birth && found != ids.end() && *found == event.id)
            stress[static_cast<std::size_t>(found - ids.begin())] = unknown;
    }
    return stress;
}

void write_descriptions(const RunDirectory& directory, const Scene& scene) {
    for (const DescribedTable& table : described_tables(scene))
        replace_file(directory.file(table.name + ".json"), series_description(table.name, table.columns));
}

}  // namespace

std::vector<DescribedTable> described_tables(const Scene& scene) {
    std::vector<DescribedTable> tables = {{"series", series_columns(scene).about()}};
    for (const SideTable& table : side_tables(scene))
        if (table.wanted) tables.push_back({table.name, table.columns});
    return tables;
}

RunFiles::RunFiles(const RunDirectory& directory, const Scene& scene, std::string resolved_scene,
                   const Simulation& simulation, const StepSums& sums)
    : directory_(directory),
      scene_(scene),
      resolved_scene_(std::move(resolved_scene)),
      series_file_(SeriesFile::create(directory.file("series.csv"), series_columns(scene).about())),
      contact_columns_(contact_columns(scene)),
      lineage_columns_(lineage_columns(scene)) {
    if (keeps_frames(scene)) {
        const bool stress = scene.output.stress_per_rod;
        journal_ = TrajectoryJournal::create(
            directory.file("trajectory.journal"),
            stress ? TrajectoryJournal::Content::rods_and_stress : TrajectoryJournal::Content::rods);
        append_frame(simulation);
    }
    const auto tables = side_tables(scene);
    for (std::size_t k = 0; k < tables.size(); ++k) {
        if (!tables[k].wanted) continue;
        side_files_[k] = SeriesFile::create(directory.file(tables[k].name + ".csv"), tables[k].columns);
    }
    write_descriptions(directory, scene);
    write_checkpoint(simulation, sums);
}

RunFiles::RunFiles(const RunDirectory& directory, const Scene& scene, std::string resolved_scene,
                   const Checkpoint& checkpoint)
    : directory_(directory),
      scene_(scene),
      resolved_scene_(std::move(resolved_scene)),
      series_file_(resumed_series(directory, scene, checkpoint)),
      contact_columns_(contact_columns(scene)),
      lineage_columns_(lineage_columns(scene)) {
    if (keeps_frames(scene))
        journal_ = TrajectoryJournal::resume(directory.file("trajectory.journal"), checkpoint.trajectory_bytes,
                                             checkpoint.trajectory_hash);
    const auto tables = side_tables(scene);
    for (std::size_t k = 0; k < tables.size(); ++k)
        if (tables[k].wanted)
            side_files_[k] = SeriesFile::resume(directory.file(tables[k].name + ".csv"), tables[k].columns,
                                                checkpoint.*tables[k].bytes, checkpoint.*tables[k].hash);
    write_descriptions(directory, scene);  // what was there may be damaged
}

void RunFiles::append_row(const std::vector<double>& row) {
    series_file_.append(row);
}

void RunFiles::append_frame(const Simulation& simulation) {
    const Rods rods = in_order_of_ids(simulation.rods());
    std::vector<Mat3> stress;
    if (scene_.output.stress_per_rod) stress = stress_of_last_step(simulation, rods.id);
    journal_->append(simulation.clock().step, simulation.clock().time, simulation.box(), rods, stress);
}

void RunFiles::append_contacts(const Simulation& simulation) {
    append(contacts_table, contact_rows(contact_columns_, simulation));
}

void RunFiles::append_lineage(const Simulation& simulation) {
    append(lineage_table, lineage_rows(lineage_columns_, simulation));
}

void RunFiles::append_field(const TableRows& rows) {
    append(field_table, rows);
}

void RunFiles::append(std::size_t table, const TableRows& rows) {
    for (const std::vector<double>& row : rows) side_files_[table]->append(row);
}

void RunFiles::write_checkpoint(const Simulation& simulation, const StepSums& sums) {
    Checkpoint checkpoint = checkpoint_of(simulation, sums, resolved_scene_);
    series_file_.sync();
    checkpoint.series_bytes = series_file_.bytes();
    checkpoint.series_hash = series_file_.hash();
    if (journal_) {
        journal_->sync();
        checkpoint.trajectory_bytes = journal_->bytes();
        checkpoint.trajectory_hash = journal_->hash();
    }
    const auto tables = side_tables(scene_);
    for (std::size_t k = 0; k < tables.size(); ++k) {
        if (!side_files_[k]) continue;
        side_files_[k]->sync();
        checkpoint.*tables[k].bytes = side_files_[k]->bytes();
        checkpoint.*tables[k].hash = side_files_[k]->hash();
    }
    jostle::write_checkpoint(directory_.path(), checkpoint);
}
