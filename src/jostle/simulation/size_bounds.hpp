#pragma once

#include <vector>

#include "jostle/contact/collision_search.hpp"
#include "jostle/domain/domain.hpp"
#include "jostle/mobility/mobility.hpp"
#include "jostle/simulation/known_motion.hpp"
#include "jostle/simulation/simulation_settings.hpp"

namespace jostle {

/// What follows from the sizes of the rods alone: these change where cells grow, divide or die.
struct SizeBounds {
    std::size_t rods = 0;  ///< of all ranks
    double mean_diameter = 0.0, mean_length = 0.0, max_diameter = 0.0;
    std::vector<RodMobility> own_mobility;  ///< (N); (0) where steps are not reflected
};

/// `mobility`: of these rods, of which the domain's own ones count.
void find_size_bounds(const Rods& rods, const Domain& domain, const MobilityOperator& mobility,
                      const SimulationSettings& settings, SizeBounds& sizes);

/// The step as the search for contacts sees it. Holds references. `previous_forces`: how many all ranks know of the
/// step before.
StepGeometry step_geometry(const State& state, const KnownMotion& known, const SizeBounds& sizes,
                           const SimulationSettings& settings, const Domain& domain, std::size_t previous_forces);

}  // namespace jostle
