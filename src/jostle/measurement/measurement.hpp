#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "jostle/measurement/frame_steps.hpp"
#include "jostle/measurement/run_length.hpp"
#include "jostle/measurement/series_columns.hpp"
#include "jostle/measurement/side_tables.hpp"
#include "jostle/measurement/step_sums.hpp"
#include "jostle/run_files/series_file.hpp"
#include "jostle/scene/scene.hpp"
#include "jostle/simulation/simulation.hpp"
#include "jostle/statistics/time_series.hpp"

namespace jostle {

/// What is due after a step; the periods are those of `Scene::Output`.
struct Due {
    bool row = false;    ///< of the series, which has it
    bool field = false;  ///< Measurement::last_field has it
    bool frame = false;
    bool checkpoint = false;
};

/// What a run measures while it makes steps: sums over steps, the rows of its series, its stress fields, and the
/// averages of all that with their error bars. The command, Python and programs of one's own all measure by it:
///
///     Measurement measurement(scene, simulation);
///     while (!measurement.is_complete()) measurement.add(simulation.step(), simulation);
///     const auto summary = measurement.summary(simulation);
class Measurement {
public:
    /// Of a run that begins; `simulation` stands at its beginning.
    Measurement(const Scene& scene, const Simulation& simulation);
    /// Of a run that goes on, from the sums of its checkpoint (`StepSums::from_named`) and the rows that it has.
    /// Without these, it knows of the rows to come only.
    Measurement(const Scene& scene, const Simulation& simulation, StepSums sums, SeriesTable earlier_rows = {});

    /// To be told before the simulation is shared between ranks, which then all measure together; fields,
    /// `is_complete` and `summary` are for rank 0. Errors: InputError for swimmers that grow, as their paths are
    /// remembered by ids that all ranks know from the beginning.
    void share(const Ranks& ranks);

    /// Takes in a step that `simulation` has just made. Throws std::logic_error if its contacts were not resolved.
    Due add(const StepReport& report, const Simulation& simulation);

    /// Whether the series is as long as `time.equilibration` and `time.production` ask for: where equilibration is to
    /// be detected, whether it was reached so long ago.
    bool is_complete();
    /// From 0 to 1; with equilibration to be detected, as if it took a quarter of the production.
    double fraction_done() const;

    /// What summary.json holds, of the rows so far: averages over production with standard errors, the verdict on
    /// equilibrium, and checks (docs/guide/results.md). Errors: InputError if there is no such row yet, or no rod left.
    nlohmann::ordered_json summary(const Simulation& simulation) const;
    /// The average of a column of one's own over production, with the error bar of those there (`average_in_window`).
    Average average_of(std::span<const double> rows, const Simulation& simulation) const;

    const SeriesTable& series() const { return series_; }
    /// Of series.csv.
    std::vector<double> last_row() const;
    /// Rows of field.csv, of the last field that is complete; empty before the first.
    const TableRows& last_field() const { return last_field_; }
    const StepSums& sums() const { return sums_; }

private:
    Scene scene_;
    TableColumns<RowState> series_columns_;
    TableColumns<FieldState> field_columns_;
    StepSums sums_;
    SeriesTable series_;
    TableRows last_field_;
    double begin_;  ///< time of the beginning of the first row in `series_`
    RunLength length_;
    FrameSteps frame_steps_;
    bool is_complete_ = false;
};

}  // namespace jostle
