#include "jostle/measurement/measurement.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "jostle/error/input_error.hpp"
#include "jostle/measurement/summary.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/schedule.hpp"
#include "jostle/setup/free_clocks.hpp"
#include "jostle/setup/largest_overlap.hpp"

namespace jostle {

namespace {

/// The rows that a series has, under the names of its columns.
SeriesTable begun(SeriesTable rows, const TableColumns<RowState>& columns) {
    if (!rows.names.empty()) return rows;
    for (const auto& column : columns.columns) rows.names.push_back(column.about.name);
    rows.columns.resize(rows.names.size());
    return rows;
}

}  // namespace

Measurement::Measurement(const Scene& scene, const Simulation& simulation)
    : Measurement(scene, simulation, first_sums(scene, simulation)) {}

Measurement::Measurement(const Scene& scene, const Simulation& simulation, StepSums sums, SeriesTable earlier_rows)
    : scene_(scene),
      series_columns_(series_columns(scene)),
      field_columns_(field_columns(scene)),
      sums_(std::move(sums)),
      series_(begun(std::move(earlier_rows), series_columns_)),
      begin_(series_.rows() > 0 ? 0.0 : simulation.clock().time - sums_.steps * simulation.settings().time_step),
      length_(scene_, simulation.settings().time_step, free_clocks(scene_, simulation), begin_),
      frame_steps_(scene_, simulation.settings().time_step, static_cast<double>(simulation.rods().size())) {}

void Measurement::share(const Ranks& ranks) {
    if (!ranks.alone() && swims(scene_) && grows(scene_))
        throw InputError({.key = "growth",
                          .problem = "swimmers that grow are not ready for several ranks",
                          .suggestion = "Run it on one"});
    sums_.share(ranks);
}

Due Measurement::add(const StepReport& report, const Simulation& simulation) {
    if (report.status != LcpStatus::converged) throw std::logic_error("a step that was not made cannot be measured");
    sums_.add(report, simulation);
    if (simulation.rods_in_all() == 0) return {};
    const auto due = [step = simulation.clock().step](std::uint64_t every) { return every > 0 && step % every == 0; };
    const std::optional<double>& limit = scene_.pressure.limit_volume_fraction;
    if (limit && volume_of_rods(simulation) >= *limit * simulation.box().volume()) is_complete_ = true;
    const Scene::Output& output = scene_.output;
    const Due now = {due(output.series_every), due(output.field_every), frame_steps_.is_due(simulation.clock().step),
                     due(output.checkpoint_every)};
    if (now.row) {
        sums_.measure_swimmers(scene_, simulation);
        const std::vector<double> row = series_columns_.row(RowState(simulation, sums_));
        for (std::size_t k = 0; k < row.size(); ++k) series_.columns[k].push_back(row[k]);
        sums_.start_row();
    }
    if (now.field) {
        last_field_ = field_rows(field_columns_, simulation.clock(), *sums_.field);
        sums_.field->clear();
    }
    return now;
}

bool Measurement::is_complete() {
    is_complete_ = is_complete_ || length_.is_over(series_);
    return is_complete_;
}

double Measurement::fraction_done() const {
    return length_.fraction_done(series_.rows());
}

std::vector<double> Measurement::last_row() const {
    std::vector<double> row;
    for (const auto& column : series_.columns) row.push_back(column.back());
    return row;
}

nlohmann::ordered_json Measurement::summary(const Simulation& simulation) const {
    const double now = largest_overlap(simulation.rods(), simulation.box());  // steps report that with which they begin
    return summarise(scene_, simulation, series_, std::max(sums_.run_max_overlap, now), begin_);
}

Average Measurement::average_of(std::span<const double> rows, const Simulation& simulation) const {
    return average_in_window(scene_, simulation, series_, rows, begin_);
}

}  // namespace jostle
