#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "jostle/mobility/mobility.hpp"
#include "jostle/motion/brownian_motion.hpp"
#include "jostle/motion/self_propulsion.hpp"
#include "jostle/scene/scene.hpp"

// How the rods of a scene move by themselves.

namespace jostle {

/// kT of the Brownian motion; 0 where there is none.
double thermal_energy(const Scene& scene);

/// How the rods of a scene swim.
Swimming swimming_of(const Scene& scene);

/// Whether its rods swim, now or later.
bool swims(const Scene& scene);

/// Whether its rods are cells that grow, divide and die.
inline bool grows(const Scene& scene) {
    return scene.growth.rate > 0.0;
}

/// Whether its swimmers stir the fluid (motion.force_dipole).
bool stirs(const Scene& scene);

/// Whether torques turn its rods (forces.alignment_energy).
bool has_torques(const Scene& scene);

/// Whether a constant force drags its rods along a direction in which no wall stops them.
bool drifts(const Scene& scene);

/// All motions of the scene, in the order in which a step adds them up.
std::vector<std::unique_ptr<Motion>> motions_of(const Scene& scene);

/// Whether the rods come to equilibrium, but for springs: they are thermal, none grows, and no motion drives them.
bool keeps_equilibrium(const Scene& scene);

/// How long a free swimmer keeps its direction, 1/(2 D_R/f + tumble rate + 2 reversal rate), in the plane
/// with D_R for 2 D_R: of the first `rod_count` rods the one that does so longest; infinite without rotation, tumbles
/// and reversals. f, else 1, is by how much longer noise takes to turn it round across the barrier epsilon of an
/// aligning field, with s = epsilon/kT (e^s - 1)/(2 s)/(s/(1 + s) sqrt(s/pi) + 2^(-s - 1)), which is 1 without a
/// barrier and Brown's sqrt(pi) e^s/(2 s^(3/2)) for high ones (Phys. Rev. 130, 1677 (1963)); in the plane pi^2/4
/// I_0(s/2)^2 - (pi^2/4 - 1) e^(-s/2). They are within 9 and 12 % of the smallest eigenvalue of Smoluchowski's
/// equation.
double persistence_time(const Scene& scene, const MobilityOperator& mobility, std::size_t rod_count);

/// How long a free rod remembers how its axis lies, heads and tails alike, 1/(2 D_R + tumble rate), in the plane with
/// D_R for 2 D_R: reversals do not change it. Of the first `rod_count` rods the one that does so longest.
double axis_memory_time(const Scene& scene, const MobilityOperator& mobility, std::size_t rod_count);

/// `output.active_stress_lag`, a time; "auto": 5 persistence times, or a tenth of `time.production` where those are
/// infinite.
double active_stress_lag(const Scene& scene, const MobilityOperator& mobility, std::size_t rod_count);

}  // namespace jostle
