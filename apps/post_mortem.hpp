#pragma once

#include <string>

#include "jostle/scene/scene.hpp"
#include "jostle/simulation/simulation.hpp"

/// What the user can do about a failed step, one or two lines.
std::string advice(const jostle::StepReport& report, const jostle::Scene& scene, const jostle::Simulation& simulation);

/// post_mortem.json: the failed step, its report, and the contacts with the largest forces and overlaps.
void write_post_mortem(const std::string& path, const jostle::Simulation& simulation, const jostle::StepReport& report,
                       const std::string& failure);
