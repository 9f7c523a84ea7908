#pragma once

#include <span>
#include <string>
#include <vector>

#include "jostle/mobility/mobility.hpp"
#include "jostle/motion/step_limit.hpp"
#include "jostle/rods/spring.hpp"
#include "jostle/scene/scene.hpp"

namespace jostle {

/// The time step of a scene: `time.step`; or that of `time.rms_step` = sqrt(2 D_t dt)/D with D_t = kT (parallel + 2
/// perpendicular)/3 of the fastest rod and D the thinnest; or, if it names neither, the longest at which every limit
/// has at most its automatic amount, of diffusion that of `time.accuracy` if it is given, and less if rods order. With
/// growth the latter is a function of the scene alone. Throws InputError (time.step) if there is no limit to find a
/// step from.
double time_step(const Scene& scene, const Mobility& model, const Box& box, const Rods& rods,
                 std::span<const Spring> springs = {});

/// Throws InputError for the first limit whose largest amount the step goes beyond.
void require_short_step(std::span<const StepLimit> limits, double step);

/// One sentence for each limit whose advised amount, though not the largest, the step goes beyond.
std::vector<std::string> warnings_of_step(std::span<const StepLimit> limits, double step);

/// Throws InputError if the production is shorter than a step, or a time of the scene takes more steps than a double
/// can count.
void require_countable_steps(const Scene& scene, double time_step);

}  // namespace jostle
