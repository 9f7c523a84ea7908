#include "run_files.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "jostle/disk/durable_file.hpp"
#include "jostle/measurement/series_columns.hpp"
#include "jostle/rods/space_filling_order.hpp"
#include "jostle/scene/units.hpp"
#include "jostle/simulation/contact_by_id.hpp"
#include "jostle/stress/stress_per_rod.hpp"

using namespace jostle;

namespace {

std::vector<SeriesColumn> contact_columns(const Scene& scene) {
    const std::string length = unit_of(scene, dimension::length);
    return {{"step", "1", "k", "number of steps done", ""},
            {"id_i", "1", "i", "id of the first rod", ""},
            {"id_j", "1", "j", "id of the second rod", ""},
            {"image_x", "1", "", "box edges by which the second rod is displaced", ""},
            {"image_y", "1", "", "box edges by which the second rod is displaced", ""},
            {"image_z", "1", "", "box edges by which the second rod is displaced", ""},
            {"force", unit_of(scene, dimension::force), "gamma", "contact force", "positive: repulsive"},
            {"gap", length, "Phi", "gap before the step", "negative: overlap"},
            {"normal_x", "1", "n", "unit vector from the first to the second rod", ""},
            {"normal_y", "1", "n", "unit vector from the first to the second rod", ""},
            {"normal_z", "1", "n", "unit vector from the first to the second rod", ""},
            {"arm_i", length, "s_i", "position of the contact along the first rod's axis, from its centre", ""},
            {"arm_j", length, "s_j", "position of the contact along the second rod's axis, from its centre", ""}};
}

std::vector<SeriesColumn> lineage_columns(const Scene& scene) {
    return {{"step", "1", "k", "number of steps done", ""},
            {"time", unit_of(scene, dimension::time), "t", "simulated time", ""},
            {"birth", "1", "", "1: a cell was born; 0: it died", ""},
            {"id", "1", "i", "id of the cell", ""},
            {"mother", "1", "", "id of the cell that divided, and lives on behind it; of a death: its own id", ""},
            {"length", unit_of(scene, dimension::length), "L", "length of the cell then", ""}};
}

std::vector<SeriesColumn> field_columns(const Scene& scene) {
    const std::string length = unit_of(scene, dimension::length);
    std::vector<SeriesColumn> columns = {
        {"step", "1", "k", "number of steps done", ""},
        {"time", unit_of(scene, dimension::time), "t", "simulated time", ""},
        {"x", length, "", "centre of the cell; not a number: all that lies beyond open edges of the box", ""},
        {"y", length, "", "centre of the cell", ""},
        {"z", length, "", "centre of the cell", ""},
        {"number_density", unit_of(scene, dimension::number_density), "n",
         "rods per volume in the cell, mean over the steps since the last field", ""}};
    for (const char* name : stress_column_names)
        columns.push_back(
            {name, unit_of(scene, dimension::stress), "Sigma_col",
             "element of the collision stress in the cell (position, force), mean over the steps since the "
             "last field",
             "positive in compression"});
    for (const char* name : orientation_stress_column_names)
        columns.push_back({name, unit_of(scene, dimension::stress), "Sigma_ori",
                           "element of the orientation stress in the cell, symmetric, mean over the steps since the "
                           "last field",
                           "positive in compression"});
    return columns;
}

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
    return {{{"contacts", scene.output.contacts, contact_columns(scene), &Checkpoint::contacts_bytes,
              &Checkpoint::contacts_hash},
             {"lineage", scene.growth.rate > 0.0, lineage_columns(scene), &Checkpoint::lineage_bytes,
              &Checkpoint::lineage_hash},
             {"field", scene.output.field_every > 0, field_columns(scene), &Checkpoint::field_bytes,
              &Checkpoint::field_hash}}};
}

std::vector<std::string> names_of(const std::vector<SeriesColumn>& columns) {
    std::vector<std::string> names;
    for (const SeriesColumn& column : columns) names.push_back(column.name);
    return names;
}

/// The series, cut back to the checkpoint, after all files of the run were found to be sound.
SeriesFile resumed_series(const RunDirectory& directory, const Scene& scene, const Checkpoint& checkpoint) {
    if (scene.output.trajectory_every > 0)
        TrajectoryJournal::require_frames(directory.file("trajectory.journal"), checkpoint.trajectory_bytes,
                                          checkpoint.trajectory_hash);
    for (const SideTable& table : side_tables(scene))
        if (table.wanted)
            SeriesFile::require_prefix(directory.file(table.name + ".csv"), table.columns, checkpoint.*table.bytes,
                                       checkpoint.*table.hash);
    return SeriesFile::resume(directory.file("series.csv"), series_columns(scene), checkpoint.series_bytes,
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
    std::vector<DescribedTable> tables = {{"series", series_columns(scene)}};
    for (const SideTable& table : side_tables(scene))
        if (table.wanted) tables.push_back({table.name, table.columns});
    return tables;
}

RunFiles::RunFiles(const RunDirectory& directory, const Scene& scene, std::string resolved_scene,
                   const Simulation& simulation, const StepSums& sums)
    : directory_(directory),
      scene_(scene),
      resolved_scene_(std::move(resolved_scene)),
      series_file_(SeriesFile::create(directory.file("series.csv"), series_columns(scene))) {
    series_ = {directory.file("series.csv"), names_of(series_file_.columns()),
               std::vector<std::vector<double>>(series_file_.columns().size())};
    if (scene.output.trajectory_every > 0) {
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
      series_(read_series(directory.file("series.csv"))) {
    if (scene.output.trajectory_every > 0)
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
    for (std::size_t k = 0; k < row.size(); ++k) series_.columns[k].push_back(row[k]);
}

void RunFiles::append_frame(const Simulation& simulation) {
    const Rods rods = reordered(simulation.rods(), id_order(simulation.rods()));
    std::vector<Mat3> stress;
    if (scene_.output.stress_per_rod) stress = stress_of_last_step(simulation, rods.id);
    journal_->append(simulation.clock().step, simulation.clock().time, simulation.box(), rods, stress);
}

void RunFiles::append_contacts(const Simulation& simulation) {
    for (std::size_t l = 0; l < simulation.contacts().size(); ++l) {
        const double force = simulation.contact_solution().gamma[l];
        if (force <= 0.0) continue;
        const auto& [id, image, normal, arm] = contact_by_id(simulation, l);
        const std::vector<double> row = {static_cast<double>(simulation.clock().step),
                                         static_cast<double>(id[0]),
                                         static_cast<double>(id[1]),
                                         static_cast<double>(image[0]),
                                         static_cast<double>(image[1]),
                                         static_cast<double>(image[2]),
                                         force,
                                         simulation.contacts().contact[l].gap,
                                         normal.x,
                                         normal.y,
                                         normal.z,
                                         arm[0],
                                         arm[1]};
        side_files_[contacts_table]->append(row);
    }
}

void RunFiles::append_lineage(const Simulation& simulation) {
    const Clock& clock = simulation.clock();
    for (const LineageEvent& event : simulation.lineage()) {
        const std::vector<double> row = {static_cast<double>(clock.step),
                                         clock.time,
                                         event.kind == LineageEvent::Kind::birth ? 1.0 : 0.0,
                                         static_cast<double>(event.id),
                                         static_cast<double>(event.mother),
                                         event.length};
        side_files_[lineage_table]->append(row);
    }
}

void RunFiles::append_field(const Simulation& simulation, const StressField& field) {
    const auto append = [&](const Vec3& centre, const StressField::Content& content) {
        std::vector<double> row = {static_cast<double>(simulation.clock().step),
                                   simulation.clock().time,
                                   centre.x,
                                   centre.y,
                                   centre.z,
                                   content.number_density};
        row.insert(row.end(), content.collision.m.begin(), content.collision.m.end());
        append_upper(row, content.orientation);
        side_files_[field_table]->append(row);
    };
    for (std::size_t cell = 0; cell < field.size(); ++cell) append(field.centre(cell), field.mean(cell));
    const double nowhere = std::numeric_limits<double>::quiet_NaN();
    if (field.has_outside()) append({nowhere, nowhere, nowhere}, field.outside_mean());
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
