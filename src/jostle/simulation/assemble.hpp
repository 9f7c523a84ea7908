#pragma once

#include <memory>
#include <optional>

#include "jostle/motion/self_propulsion.hpp"
#include "jostle/simulation/scene.hpp"
#include "jostle/simulation/simulation.hpp"
#include "jostle/stress/stress_field.hpp"

namespace jostle {

/// The mobility that a scene asks for, with the coefficients of `rods`.
std::unique_ptr<Mobility> make_mobility(const Scene& scene, const Rods& rods);

/// The time step of a scene: `time.step`, or from `time.rms_step` = sqrt(2 D_t dt)/D with D_t = kT (parallel + 2
/// perpendicular)/3 of the fastest rod.
double time_step(const Scene& scene, const Mobility& mobility, const Rods& rods);

/// D_t of the fastest rod of an assembly.
double fastest_diffusion(double kT, const Mobility& mobility, std::size_t rod_count);

/// kT of the Brownian motion; 0 where there is none.
double thermal_energy(const Scene& scene);

/// How the rods of a scene swim.
Swimming swimming_of(const Scene& scene);

/// Throws InputError where rods swim or tumble too fast for the time step: they, or the ends of one, or of a cell as
/// long as it gets, could pass through others.
void require_slow_swimmers(const Scene& scene, const Rods& rods, double time_step);

/// How long a free swimmer keeps its direction, 1/(2 D_R + tumble rate + 2 reversal rate): of the first `rod_count`
/// rods the one that does so longest; infinite without rotation, tumbles and reversals.
double persistence_time(const Scene& scene, const Mobility& mobility, std::size_t rod_count);

/// `output.active_stress_lag`, a time; "auto": 5 persistence times, or a tenth of `time.production` where those are
/// infinite.
double active_stress_lag(const Scene& scene, const Mobility& mobility, std::size_t rod_count);

/// The stress field that a scene asks for, without steps, if any. Throws InputError where its cells are too many.
std::optional<StressField> make_field(const Scene& scene, const Box& box);

/// Throws InputError (springs.file) if springs would lose more than all of their stretch in a step, by
/// `spring_relaxation`.
void require_slow_springs(const Scene& scene, double relaxation, double time_step);

/// A simulation of a scene that starts at, or goes on from, the given state. `springs`: of `scene.springs.file`, with
/// their images. `last_forces`: of the state, Simulation::last_forces. Errors: InputError, also if that file is named
/// and there are no springs.
Simulation assemble(const Scene& scene, const Box& box, Rods rods, Clock clock, std::vector<Spring> springs = {},
                    std::vector<LastForce> last_forces = {});

}  // namespace jostle
