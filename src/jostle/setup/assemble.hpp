#pragma once

#include <memory>
#include <optional>

#include "jostle/scene/scene.hpp"
#include "jostle/simulation/simulation.hpp"
#include "jostle/stress/stress_field.hpp"

namespace jostle {

/// The mobility that a scene asks for.
std::unique_ptr<Mobility> make_mobility(const Scene& scene);

/// The time step of a scene: `time.step`, or from `time.rms_step` = sqrt(2 D_t dt)/D with D_t = kT (parallel + 2
/// perpendicular)/3 of the fastest rod. Throws InputError where it is too long for growth.
double time_step(const Scene& scene, const MobilityOperator& mobility, const Rods& rods);

/// The stress field that a scene asks for, without steps, if any. Throws InputError where its cells are too many.
std::optional<StressField> make_field(const Scene& scene, const Box& box);

/// A simulation of a scene that starts at, or goes on from, the given state, whose springs are those of
/// `scene.springs.file`, with their images. Errors: InputError, also if that file is named and there are no springs.
Simulation assemble(const Scene& scene, State state);

}  // namespace jostle
