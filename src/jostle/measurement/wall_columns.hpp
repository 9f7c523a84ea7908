#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "jostle/measurement/series_columns.hpp"
#include "jostle/measurement/summary_entries.hpp"
#include "jostle/rods/wall.hpp"

namespace jostle {

/// Walls that one pressure belongs to: the two faces across a direction, or the container.
struct WallGroup {
    std::string column;           ///< of the pressure: "wall_pressure_z"; of a container "wall_pressure"
    std::string in_words;         ///< "both planes across z", "the sphere"
    std::uint32_t first, number;  ///< of walls, by their numbers
};

std::vector<WallGroup> wall_groups(const Walls& walls);

/// "wall_force_x_lower"; of a container "wall_force".
std::string force_column(const Wall& wall);

/// The force on each wall, and the pressure of each group, mean over the steps since the last row.
void add_wall_columns(const Scene& scene, TableColumns<RowState>& series);

/// The pressure on a group of walls over the whole stress along their normal: 1 in equilibrium (theory, eq. 6.4).
/// `stress`: the nine columns of the whole stress; `pressure`: that of the group.
nlohmann::ordered_json wall_pressure_check(const WallGroup& group, const Walls& walls, const Columns& stress,
                                           const std::vector<double>& pressure);

}  // namespace jostle
