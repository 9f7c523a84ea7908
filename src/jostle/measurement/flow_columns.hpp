#pragma once

#include "jostle/measurement/series_columns.hpp"

namespace jostle {

/// Six each, symmetric: xx xy xz yy yz zz.
inline constexpr std::array<const char*, 6> geometric_stress_column_names = {
    "stress_geometric_xx", "stress_geometric_xy", "stress_geometric_xz",
    "stress_geometric_yy", "stress_geometric_yz", "stress_geometric_zz"};
inline constexpr std::array<const char*, 6> flow_stress_column_names = {
    "stress_flow_xx", "stress_flow_xy", "stress_flow_xz", "stress_flow_yy", "stress_flow_yz", "stress_flow_zz"};

/// The strain, and both sides of the identity of torques (theory, eq. 8.5).
void add_flow_columns(const Scene& scene, TableColumns<RowState>& series);

}  // namespace jostle
