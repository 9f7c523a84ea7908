#pragma once

#include <span>
#include <vector>

#include "jostle/motion/springs.hpp"
#include "jostle/motion/step_limit.hpp"
#include "jostle/rods/box.hpp"
#include "jostle/rods/rods.hpp"
#include "jostle/scene/scene.hpp"

// What a time step must not be too long for.

namespace jostle {

/// All limits for these rods: of each motion of the scene, of growth, springs, a soft potential, and of rods that meet
/// their own periodic images. `springs`: of the file that the scene names; where `rods` holds one rod for all alike,
/// their ids need not be its. With growth, cells that are yet to come count, too; with a schedule, the largest values
/// that it has, and the narrowest box.
std::vector<StepLimit> step_limits(const Scene& scene, const Mobility& model, const Box& box, const Rods& rods,
                                   std::span<const Spring> springs = {});

/// The shortest edge of a periodic box in which a step of this length lets no rod turn farther than its own images do.
double least_edge_between_images(const Rods& rods, const MobilityOperator& mobility, double kT, double time_step);

/// Those of motions and growth alone.
std::vector<StepLimit> free_step_limits(const Scene& scene, const Mobility& model, const Box& box, const Rods& rods);

/// Those of growth alone, of cells of this diameter.
std::vector<StepLimit> growth_limits(const Scene& scene, double diameter);

/// Limits that stay the same while cells grow, divide and die: those of what the scene says of cells, not of the cells
/// there are.
std::vector<StepLimit> lasting_step_limits(const Scene& scene, const Mobility& model, const Box& box);

/// That of contact.model = "wca": over the overlap of two rods that meet with 5 kT (one encounter in 150), how far
/// apart their force throws them in a step, at most: dt U'' 2 m (theory, eq. 2.20), with m the larger mobility of a
/// rod's end. Above 2 they come to lie farther apart than they overlapped, and throw others.
StepLimit potential_limit(const Scene& scene, const Rods& rods, const MobilityOperator& mobility);

/// That of springs: the part of their stretch that they lose (`spring_relaxation`).
StepLimit spring_limit(const Scene& scene, std::span<const Spring> springs, const Rods& rods,
                       const MobilityOperator& mobility);

}  // namespace jostle
