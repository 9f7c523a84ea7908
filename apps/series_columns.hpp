#pragma once

#include <array>
#include <vector>

#include "jostle/io/series_file.hpp"
#include "jostle/simulation/scene.hpp"
#include "jostle/simulation/simulation.hpp"
#include "step_sums.hpp"

/// Names of the nine stress columns, by rows of the tensor.
inline constexpr std::array<const char*, 9> stress_column_names = {"stress_xx", "stress_xy", "stress_xz",
                                                                   "stress_yx", "stress_yy", "stress_yz",
                                                                   "stress_zx", "stress_zy", "stress_zz"};
/// Names of the six independent columns of the order tensor, xx xy xz yy yz zz.
inline constexpr std::array<const char*, 6> order_tensor_column_names = {"order_xx", "order_xy", "order_xz",
                                                                         "order_yy", "order_yz", "order_zz"};

/// The columns of series.csv, with unit, definition and sign of each.
std::vector<jostle::SeriesColumn> series_columns(jostle::UnitSystem units);

/// One row: means over the steps in `sums`, and the order of the rods as they are now.
std::vector<double> series_row(const jostle::Simulation& simulation, const StepSums& sums);
