#include "run_files.hpp"

#include <utility>

#include "jostle/io/units.hpp"
#include "jostle/rods/space_filling_order.hpp"
#include "series_columns.hpp"

using namespace jostle;

namespace {

std::vector<SeriesColumn> contact_columns(UnitSystem units) {
    const std::string length = unit_of(units, dimension::length);
    return {{"step", "1", "k", "number of steps done", ""},
            {"id_i", "1", "i", "id of the first rod", ""},
            {"id_j", "1", "j", "id of the second rod", ""},
            {"image_x", "1", "", "box edges by which the second rod is displaced", ""},
            {"image_y", "1", "", "box edges by which the second rod is displaced", ""},
            {"image_z", "1", "", "box edges by which the second rod is displaced", ""},
            {"force", unit_of(units, dimension::force), "gamma", "contact force", "positive: repulsive"},
            {"gap", length, "Phi", "gap before the step", "negative: overlap"},
            {"normal_x", "1", "n", "unit vector from the first to the second rod", ""},
            {"normal_y", "1", "n", "unit vector from the first to the second rod", ""},
            {"normal_z", "1", "n", "unit vector from the first to the second rod", ""},
            {"arm_i", length, "s_i", "position of the contact along the first rod's axis, from its centre", ""},
            {"arm_j", length, "s_j", "position of the contact along the second rod's axis, from its centre", ""}};
}

std::vector<std::string> names_of(const std::vector<SeriesColumn>& columns) {
    std::vector<std::string> names;
    for (const SeriesColumn& column : columns) names.push_back(column.name);
    return names;
}

/// The series, cut back to the checkpoint, after all files of the run were found to be sound.
SeriesFile resumed_series(const RunDirectory& directory, const Scene& scene, const Checkpoint& checkpoint) {
    if (scene.output.trajectory_every > 0)
        TrajectoryJournal::require_frames(directory.file("trajectory.journal"), checkpoint.trajectory_bytes);
    if (scene.output.contacts)
        SeriesFile::require_prefix(directory.file("contacts.csv"), contact_columns(scene.units.system),
                                   checkpoint.contacts_bytes, checkpoint.contacts_hash);
    return SeriesFile::resume(directory.file("series.csv"), series_columns(scene), checkpoint.series_bytes,
                              checkpoint.series_hash);
}

}  // namespace

RunFiles::RunFiles(const RunDirectory& directory, const Scene& scene, std::string resolved_scene,
                   const Simulation& simulation, const StepSums& sums)
    : directory_(directory),
      resolved_scene_(std::move(resolved_scene)),
      series_file_(SeriesFile::create(directory.file("series.csv"), series_columns(scene))) {
    series_ = {directory.file("series.csv"), names_of(series_file_.columns()),
               std::vector<std::vector<double>>(series_file_.columns().size())};
    write_series_description(directory.file("series.json"), series_file_.columns());
    if (scene.output.trajectory_every > 0) {
        journal_ = TrajectoryJournal::create(directory.file("trajectory.journal"));
        append_frame(simulation);
    }
    if (scene.output.contacts) {
        contacts_file_ = SeriesFile::create(directory.file("contacts.csv"), contact_columns(scene.units.system));
        write_series_description(directory.file("contacts.json"), contacts_file_->columns());
    }
    write_checkpoint(simulation, sums);
}

RunFiles::RunFiles(const RunDirectory& directory, const Scene& scene, std::string resolved_scene,
                   const Checkpoint& checkpoint)
    : directory_(directory),
      resolved_scene_(std::move(resolved_scene)),
      series_file_(resumed_series(directory, scene, checkpoint)),
      series_(read_series(directory.file("series.csv"))) {
    if (scene.output.trajectory_every > 0)
        journal_ = TrajectoryJournal::resume(directory.file("trajectory.journal"), checkpoint.trajectory_bytes);
    if (scene.output.contacts)
        contacts_file_ = SeriesFile::resume(directory.file("contacts.csv"), contact_columns(scene.units.system),
                                            checkpoint.contacts_bytes, checkpoint.contacts_hash);
}

void RunFiles::append_row(const std::vector<double>& row) {
    series_file_.append(row);
    for (std::size_t k = 0; k < row.size(); ++k) series_.columns[k].push_back(row[k]);
}

void RunFiles::append_frame(const Simulation& simulation) {
    const Rods& rods = simulation.rods();
    journal_->append(simulation.clock().step, simulation.clock().time, simulation.box(),
                     reordered(rods, id_order(rods)));
}

void RunFiles::append_contacts(const Simulation& simulation) {
    const Contacts& contacts = simulation.contacts();
    const Rods& rods = simulation.rods();
    for (std::size_t l = 0; l < contacts.size(); ++l) {
        const double force = simulation.contact_solution().gamma[l];
        if (force <= 0.0) continue;
        Contact contact = contacts.contact[l];
        Image image = contacts.image[l];
        if (rods.id[contact.i] > rods.id[contact.j]) {  // the smaller id first
            std::swap(contact.i, contact.j);
            std::swap(contact.arm_i, contact.arm_j);
            contact.normal = -contact.normal;
            for (std::int32_t& edges : image) edges = -edges;
        }
        const std::vector<double> row = {static_cast<double>(simulation.clock().step),
                                         static_cast<double>(rods.id[contact.i]),
                                         static_cast<double>(rods.id[contact.j]),
                                         static_cast<double>(image[0]),
                                         static_cast<double>(image[1]),
                                         static_cast<double>(image[2]),
                                         force,
                                         contact.gap,
                                         contact.normal.x,
                                         contact.normal.y,
                                         contact.normal.z,
                                         contact.arm_i,
                                         contact.arm_j};
        contacts_file_->append(row);
    }
}

void RunFiles::write_checkpoint(const Simulation& simulation, const StepSums& sums) {
    Checkpoint checkpoint;
    checkpoint.scene = resolved_scene_;
    checkpoint.step = simulation.clock().step;
    checkpoint.time = simulation.clock().time;
    checkpoint.box = simulation.box();
    checkpoint.rods = simulation.rods();
    checkpoint.accumulators = sums.to_numbers();
    series_file_.sync();
    checkpoint.series_rows = series_.rows();
    checkpoint.series_bytes = series_file_.bytes();
    checkpoint.series_hash = series_file_.hash();
    if (journal_) {
        journal_->sync();
        checkpoint.trajectory_bytes = journal_->bytes();
    }
    if (contacts_file_) {
        contacts_file_->sync();
        checkpoint.contacts_bytes = contacts_file_->bytes();
        checkpoint.contacts_hash = contacts_file_->hash();
    }
    jostle::write_checkpoint(directory_.path(), checkpoint);
}
