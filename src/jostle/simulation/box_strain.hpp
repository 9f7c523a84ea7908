#pragma once

#include "jostle/motion/motion.hpp"
#include "jostle/state/state.hpp"

namespace jostle {

/// What keeps the rods of a box at a pressure (theory, section 10).
struct PressureControl {
    double external = 0.0;    ///< of the bath
    bool orthogonal = false;  ///< every edge by itself; else all of them in one ratio
    double mobility = 0.0;    ///< of the logarithm of the volume, or of each edge: 1/(time energy)
};

/// The edges at the end of the step that the state stands before: their logarithms move as one more body, by the forces
/// of the last step and by noise of `kT` (theory, eq. 10.1). Those that it has where these forces are not known.
Vec3 edges_under_pressure(const State& state, const PressureControl& control, double kT, const StepContext& context);

}  // namespace jostle
