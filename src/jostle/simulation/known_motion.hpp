#pragma once

#include <memory>
#include <span>
#include <vector>

#include "jostle/domain/domain.hpp"
#include "jostle/motion/motion.hpp"
#include "jostle/rods/configuration.hpp"
#include "jostle/simulation/plane_motion.hpp"
#include "jostle/state/state.hpp"

namespace jostle {

/// What is known of a step before contacts are resolved (theory, section 2.1).
struct KnownMotion {
    Velocities velocity;               ///< (N) U_known, the sum of all motions
    Velocities drift;                  ///< (N) the same without noise and its thermal drift; (0) where these are all
    Configuration end;                 ///< (N) where it would take the rods
    std::vector<double> displacement;  ///< (N) by it, of any point of the rod, at most
    std::vector<SpringPull> pulls;     ///< of the springs
    Forces exerted{0};                 ///< (N) by the motions alone; (0) where they exert none
    Velocities by_forces;              ///< (N) part of U_known by `exerted` and springs; (0) without both
    PlaneMotion piston;
};

/// Makes `known` that of this state. `has_springs`: any rods, be they other ranks'.
void find_known_motion(const State& state, bool has_springs, const Domain& domain,
                       std::span<const std::unique_ptr<Motion>> motions, const MobilityOperator& mobility,
                       const StepContext& context, KnownMotion& known);

}  // namespace jostle
