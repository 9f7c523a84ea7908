#pragma once

#include <memory>
#include <optional>

#include "jostle/scene/scene.hpp"
#include "jostle/scene/scene_mobility.hpp"
#include "jostle/scene/time_step.hpp"
#include "jostle/simulation/simulation.hpp"
#include "jostle/stress/stress_field.hpp"

namespace jostle {

/// The stress field that a scene asks for, without steps, if any. Throws InputError where its cells are too many.
std::optional<StressField> make_field(const Scene& scene, const Box& box);

/// Refuses a ramp of the mean speed for rods that have speeds of their own. Errors: InputError.
void require_drawn_speeds(const Scene& scene, const Rods& rods);

/// A simulation of a scene that starts at, or goes on from, the given state, whose springs are those of
/// `scene.springs.file`, with their images. Errors: InputError, also if that file is named and there are no springs.
Simulation assemble(const Scene& scene, State state);

}  // namespace jostle
