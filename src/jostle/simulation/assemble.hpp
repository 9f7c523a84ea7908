#pragma once

#include <memory>
#include <optional>

#include "jostle/simulation/scene.hpp"
#include "jostle/simulation/simulation.hpp"

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

/// A simulation of a scene that starts at, or goes on from, the given state.
Simulation assemble(const Scene& scene, const Box& box, Rods rods, Clock clock);

}  // namespace jostle
