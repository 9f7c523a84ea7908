#include "run_files.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "jostle/disk/durable_file.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/measurement/frame_steps.hpp"
#include "jostle/measurement/series_columns.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/stress/stress_per_rod.hpp"

using namespace jostle;

namespace {

constexpr const char* series_name = "series.csv";

/// Tables beside the series.
struct SideTable {
    DescribedTable table;
    bool wanted;

    std::string file() const { return table.name + ".csv"; }
};

enum : std::size_t { contacts_table, lineage_table, field_table };

std::array<SideTable, 3> side_tables(const Scene& scene) {
    return {{{{"contacts", contact_columns(scene).about()}, scene.output.contacts},
             {{"lineage", lineage_columns(scene).about()}, grows(scene)},
             {{"field", field_columns(scene).about()}, scene.output.field_every > 0}}};
}

TrajectoryJournal::Content journal_content(const Scene& scene) {
    return scene.output.stress_per_rod ? TrajectoryJournal::Content::rods_and_stress : TrajectoryJournal::Content::rods;
}

/// Frames that the run has, which go on with the same content.
void require_frames(const std::string& path, const Scene& scene, const FilePosition& position) {
    const auto content = TrajectoryJournal::require_frames(path, position.bytes, position.hash);
    if (!keeps_frames(scene) || content == journal_content(scene)) return;
    throw InputError({.key = "output.stress_per_rod",
                      .value = scene.output.stress_per_rod ? "true" : "false",
                      .problem = scene.output.stress_per_rod ? "the frames that the run has are without it"
                                                             : "the frames that the run has are with it",
                      .suggestion = "Restore the scene, give another folder with --out, or start again with --fresh"});
}

/// The series, cut back to the checkpoint, after all files of the run were found to be sound.
SeriesFile resumed_series(const RunDirectory& directory, const Scene& scene, const FilePositions& positions) {
    if (const auto journal = positions.find(trajectory_journal_name); journal != positions.end())
        require_frames(directory.file(journal->first), scene, journal->second);
    for (const SideTable& side : side_tables(scene))
        if (const auto found = positions.find(side.file()); found != positions.end())
            SeriesFile::require_prefix(directory.file(found->first), side.table.columns, found->second.bytes,
                                       found->second.hash);
    const auto series = positions.find(series_name);
    const FilePosition position = series == positions.end() ? FilePosition{} : series->second;
    return SeriesFile::resume(directory.file(series_name), series_columns(scene).about(), position.bytes,
                              position.hash);
}

const Mat3 unknown = std::numeric_limits<double>::quiet_NaN() * Mat3{{1, 1, 1, 1, 1, 1, 1, 1, 1}};

void write_descriptions(const RunDirectory& directory, const Scene& scene) {
    for (const DescribedTable& table : described_tables(scene))
        replace_file(directory.file(table.name + ".json"), series_description(table.name, table.columns));
}

}  // namespace

std::vector<DescribedTable> described_tables(const Scene& scene) {
    std::vector<DescribedTable> tables = {{"series", series_columns(scene).about()}};
    for (const SideTable& side : side_tables(scene))
        if (side.wanted) tables.push_back(side.table);
    return tables;
}

std::vector<Mat3> stress_of_last_step(const Simulation& simulation, const RodsInOrder& rods) {
    const CollisionMoments moments = at_first_rank(simulation.collision_moments(), simulation.domain().ranks());
    const std::vector<std::uint64_t> ids = rods.ids();
    std::vector<Mat3> stress = stress_per_rod(moments, ids);
    for (const LineageEvent& event : simulation.lineage()) {
        const auto found = std::lower_bound(ids.begin(), ids.end(), event.id);
        if (event.kind == LineageEvent::Kind::birth && found != ids.end() && *found == event.id)
            stress[static_cast<std::size_t>(found - ids.begin())] = unknown;
    }
    return stress;
}

RunFiles::RunFiles(const RunDirectory& directory, const Scene& scene, const std::string& resolved_scene,
                   const Simulation& simulation, const StepSums& sums)
    : directory_(directory),
      scene_(scene),
      series_file_(SeriesFile::create(directory.file("series.csv"), series_columns(scene).about())),
      lineage_columns_(lineage_columns(scene)) {
    open_others(simulation, {});
    write_checkpoint(checkpoint_without_rods(simulation, sums, resolved_scene), simulation.rods_in_order());
}

RunFiles::RunFiles(const RunDirectory& directory, const Scene& scene, const Simulation& simulation,
                   const FilePositions& positions)
    : directory_(directory),
      scene_(scene),
      series_file_(resumed_series(directory, scene, positions)),
      lineage_columns_(lineage_columns(scene)) {
    open_others(simulation, positions);
}

/// Those that the run has go on, also if the scene no longer asks for them; those that it now asks for begin.
void RunFiles::open_others(const Simulation& simulation, const FilePositions& positions) {
    const std::string frames = directory_.file(trajectory_journal_name);
    if (const auto found = positions.find(trajectory_journal_name); found != positions.end()) {
        journal_ = TrajectoryJournal::resume(frames, found->second.bytes, found->second.hash);
    } else if (keeps_frames(scene_)) {
        journal_ = TrajectoryJournal::create(frames, journal_content(scene_));
        append_first_frame(simulation);
    }
    const auto tables = side_tables(scene_);
    for (std::size_t k = 0; k < tables.size(); ++k) {
        const std::string path = directory_.file(tables[k].file());
        if (const auto found = positions.find(tables[k].file()); found != positions.end())
            side_files_[k] = SeriesFile::resume(path, tables[k].table.columns, found->second.bytes, found->second.hash);
        else if (tables[k].wanted)
            side_files_[k] = SeriesFile::create(path, tables[k].table.columns);
    }
    write_descriptions(directory_, scene_);  // what was there may be damaged
}

void RunFiles::append_row(const std::vector<double>& row) {
    series_file_.append(row);
}

void RunFiles::append_frame(const Simulation& simulation, const RodsInOrder& rods, const std::vector<Mat3>& stress) {
    journal_->append(simulation.clock().step, simulation.clock().time, simulation.box(), rods, stress);
}

/// No step leads to it.
void RunFiles::append_first_frame(const Simulation& simulation) {
    const RodsInOrder rods = simulation.rods_in_order();
    append_frame(simulation, rods, std::vector<Mat3>(scene_.output.stress_per_rod ? rods.size() : 0, unknown));
}

void RunFiles::append_contacts(const TableRows& rows) {
    append(contacts_table, rows);
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

void RunFiles::write_checkpoint(Checkpoint checkpoint, const RodsInOrder& rods) {
    const auto keep = [&](const std::string& name, auto& file) {
        file.sync();
        checkpoint.files[name] = {file.bytes(), file.hash()};
    };
    keep(series_name, series_file_);
    if (journal_) keep(trajectory_journal_name, *journal_);
    const auto tables = side_tables(scene_);
    for (std::size_t k = 0; k < tables.size(); ++k)
        if (side_files_[k]) keep(tables[k].file(), *side_files_[k]);
    jostle::write_checkpoint(directory_.path(), checkpoint, rods);
}
