#pragma once

#include <vector>

#include "jostle/measurement/step_sums.hpp"
#include "jostle/run_files/series_file.hpp"
#include "jostle/scene/scene.hpp"
#include "jostle/simulation/simulation.hpp"
#include "jostle/stress/column_names.hpp"

namespace jostle {

/// Appends the elements xx xy xz yy yz zz of a symmetric tensor.
void append_upper(std::vector<double>& row, const Mat3& tensor);

/// The columns of series.csv, with unit, definition and sign of each.
std::vector<SeriesColumn> series_columns(const Scene& scene);

/// One row: means over the steps in `sums`, and order and orientation stress of the rods as they are now.
std::vector<double> series_row(const Simulation& simulation, const StepSums& sums);

}  // namespace jostle
