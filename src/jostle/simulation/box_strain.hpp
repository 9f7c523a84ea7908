#pragma once

#include <cmath>

#include "jostle/contact_problem/box_column.hpp"
#include "jostle/motion/motion.hpp"
#include "jostle/simulation/step_report.hpp"
#include "jostle/state/state.hpp"

namespace jostle {

/// What keeps the rods of a box at a pressure (theory, section 10).
struct PressureControl {
    enum class Moves {
        volume,  ///< all edges in one ratio
        edges,   ///< every edge by itself
        plane    ///< the upper plane across `piston` alone, and no rod with it
    };

    double external = 0.0;  ///< of the bath
    Moves moves = Moves::volume;
    int piston = 2;         ///< direction, 0 to 2
    double mobility = 0.0;  ///< of the logarithm of the volume, or of each edge: 1/(time energy); of a plane:
                            ///< length/(time force)
    double rate = 0.0;      ///< without thermal motion: at which the logarithm of the volume falls, or the plane comes,
                            ///< where nothing resists
    double largest_move = INFINITY;  ///< in a step, by forces: of the logarithm of the volume, or of each edge
    double least_edge = 0.0;         ///< where edges move: below it rods have no room between their own images
};

/// The edges at the end of a step.
struct EdgesUnderPressure {
    Vec3 edges;
    bool held_back = false;  ///< forces would have moved them by more than a step may
};

/// The edges at the end of the step that the state stands before: their logarithms, or the plane, move as one more
/// body, by the forces of the last step and by noise of `kT` (theory, eqs. 10.1 and 10.3). Those that it has where
/// these forces are not known. Without thermal motion those that they would have if no contact resisted: `opening_of`
/// says how contact forces then open the box in the same step. `rods`: so many, of all ranks.
///
/// Forces move the box by at most `largest_move` in a step, so that one far from its pressure comes to it by steps that
/// contacts can follow. Noise is not held back.
EdgesUnderPressure edges_under_pressure(const State& state, std::size_t rods, const PressureControl& control, double kT,
                                        const StepContext& context);

/// Forces on the logarithms of the edges, or on the plane, by a step that was made: what the next one needs.
Vec3 force_on_box(const StepReport& report, const PressureControl& control);

/// Without thermal motion: the box, as it was before the step squeezed it, as a body of the contact problem (theory,
/// eq. 10.4).
BoxColumn opening_of(const Box& before, const PressureControl& control);

/// The edges after forces have opened the box for a step at this rate.
Vec3 opened(const Vec3& edges, const PressureControl& control, double rate, double time_step);

}  // namespace jostle
