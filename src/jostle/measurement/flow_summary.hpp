#pragma once

#include "jostle/measurement/summary_entries.hpp"
#include "jostle/scene/scene.hpp"

namespace jostle {

/// What is in a viscosity, and what is not.
inline constexpr const char* definition_of_viscosity =
    "of Brownian motion and collisions: without the fluid's own viscosity, Einstein's term and the drag stresslets of "
    "the rods";

/// What a flow tells of the rods, from row `first` on: in a steady one viscosity and normal stress differences, in one
/// to and fro the moduli (theory, section 8). `stress`: the nine columns of the whole stress.
nlohmann::ordered_json flow_entry(const Scene& scene, const SeriesTable& series, std::size_t first,
                                  const Columns& stress);

/// Geometric and orientation stress together against what the flow turns the axes by: equal in a steady flow, at every
/// density and rate (theory, eq. 8.5). The ratio of their elements xy, and the differences of all six.
nlohmann::ordered_json torque_ratio_check(const SeriesTable& series, std::size_t first);
nlohmann::ordered_json torque_identity_check(const SeriesTable& series, std::size_t first, const std::string& unit);

}  // namespace jostle
