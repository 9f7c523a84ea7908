#pragma once

#include <optional>
#include <string>

#include "jostle/scene/scene.hpp"
#include "jostle/simulation/simulation.hpp"

namespace jostle {

/// Why a contact problem was not solved, in words.
std::string description(LcpStatus status);

/// Why a run cannot go on after a step: contacts not resolved, rods that overlap by more than `contact.overlap_limit`
/// of the `thinnest` diameter, or an edge of the box that a bath has made too short for them. Empty after a sound step.
std::optional<std::string> step_failure(const StepReport& report, const Scene& scene, double thinnest);

/// The same, of the rods of a process that has them all.
std::optional<std::string> step_failure(const StepReport& report, const Scene& scene, const Rods& rods);

}  // namespace jostle
