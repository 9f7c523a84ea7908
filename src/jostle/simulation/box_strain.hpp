#pragma once

#include <cmath>
#include <optional>

#include "jostle/contact_problem/box_column.hpp"
#include "jostle/motion/motion.hpp"
#include "jostle/simulation/plane_motion.hpp"
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
    double mobility = 0.0;  ///< in thermal motion, of the logarithm of the volume, or of each edge: 1/(time energy); of
                            ///< a plane: length/(time force)
    double rate = 0.0;      ///< without thermal motion: at which the logarithm of the volume falls, or the plane comes,
                            ///< where nothing resists
    double largest_move = INFINITY;  ///< in a step, by forces: of the logarithm of the volume, or of each edge
    double least_edge = 0.0;         ///< where edges move: below it rods have no room between their own images
};

/// The edges at the end of a step, or those to which what is known of it would take them.
struct EdgesUnderPressure {
    Vec3 edges;
    bool held_back = false;   ///< forces would have moved them by more than a step may
    PlaneMotion piston = {};  ///< if one moves, by its load and noise
};

/// Whether contact forces move the box in the step in which they act: a plane, and any box without thermal motion.
inline bool opens_in_step(const std::optional<PressureControl>& control, double kT) {
    return control && (kT == 0.0 || control->moves == PressureControl::Moves::plane);
}

/// The edges at the end of the step that the state stands before: their logarithms move as one more body, by the forces
/// of the last step and by noise of `kT` (theory, eq. 10.1). Those that it has where these forces are not known. A
/// plane by its load and noise alone (10.3), and any box without thermal motion as if no contact resisted: `opening_of`
/// says how contact forces then open it in the same step. `rods`: so many, of all ranks.
///
/// Forces move the box by at most `largest_move` in a step, so that one far from its pressure comes to it by steps that
/// contacts can follow. Noise is not held back.
EdgesUnderPressure edges_under_pressure(const State& state, std::size_t rods, const PressureControl& control, double kT,
                                        const StepContext& context);

/// Forces on the logarithms of the edges by a step that was made: what the next one needs.
Vec3 force_on_box(const StepReport& report);

/// The box, as it was before the step squeezed it, or its piston, as a body of the contact problem (theory, eqs. 10.3a
/// and 10.4).
BoxColumn opening_of(const Box& before, const PressureControl& control);

/// The edges after forces have opened the box for a step at this rate.
Vec3 opened(const Vec3& edges, const PressureControl& control, double rate, double time_step);

}  // namespace jostle
