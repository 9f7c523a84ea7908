#pragma once

#include <vector>

#include "jostle/measurement/step_sums.hpp"
#include "jostle/measurement/table_columns.hpp"
#include "jostle/scene/scene.hpp"
#include "jostle/simulation/simulation.hpp"
#include "jostle/statistics/order_parameter.hpp"
#include "jostle/stress/column_names.hpp"
#include "jostle/stress/stress.hpp"

namespace jostle {

/// What the values of a row of the series are taken from: the state at the row's step, and the sums over the steps
/// since the last row. What several columns share is found once.
struct RowState {
    /// Holds references. `sums.steps` > 0, and there are rods. All ranks call it together.
    RowState(const Simulation& simulation, const StepSums& sums);

    const Simulation& simulation;
    const StepSums& sums;
    double volume;       ///< of the box at this step
    double rods_volume;  ///< of all rods at this step; in two dimensions areas
    double kT;           ///< mean over the steps
    double density;      ///< rods per volume, mean over the steps: cells may have divided since the last row
    Stress stress;       ///< mean over the steps; the orientation stress at this step
    NematicOrder order;  ///< at this step
    Mat3 flow_virial;    ///< what a flow turns the axes by, at this step (`sum_of_flow_stresses`)
};

/// Of all ranks; in two dimensions the area. All call it together.
double volume_of_rods(const Simulation& simulation);

/// The columns of series.csv, in their order: name, unit, symbol, definition, sign and value of each.
TableColumns<RowState> series_columns(const Scene& scene);

}  // namespace jostle
