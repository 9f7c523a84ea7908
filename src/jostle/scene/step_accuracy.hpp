#pragma once

#include <optional>
#include <string>

#include "jostle/rods/box.hpp"
#include "jostle/rods/rods.hpp"
#include "jostle/scene/scene.hpp"

namespace jostle {

/// What the validation knows of the error that a Brownian step makes in Z: it is of second order in the
/// root-mean-square step, and at rms step 0.06 D at most `at_reference` of Z (docs/validation, isotropic_pressure and
/// nematic_transition).
struct StepError {
    const char* states;  ///< of which it is known
    double at_reference;
};

/// Of rods that are isotropic, or of such that order because they are long and crowded. `rods`: all, or those that
/// stand for them (representative_rods).
StepError known_step_error(const Scene& scene, const Rods& rods, const Box& box);

/// The error of Z, over Z, at most, at this rms step (D of the thinnest rod; up to 0.1 was measured).
double largest_step_error(double rms_step, const StepError& error);

/// The longest rms step at which that is at most `accuracy`; at most 0.1.
double rms_step_of_accuracy(double accuracy, const StepError& error);

/// The rms step (D of the thinnest rod) that a scene has if it names none, its error is known, and its rods order;
/// else nothing, for then it is that of BrownianMotion::step_limits.
std::optional<double> rms_step_of_ordered_rods(const Scene& scene, const Rods& rods, const Box& box);

/// Why nothing is known of the error that a step of this scene makes: "rods swim"; empty if it is known.
std::string unknown_step_error(const Scene& scene);

}  // namespace jostle
