#pragma once

#include "jostle/contact_problem/contact_solution.hpp"
#include "jostle/domain/domain.hpp"
#include "jostle/simulation/known_motion.hpp"
#include "jostle/simulation/simulation_settings.hpp"
#include "jostle/simulation/step_report.hpp"
#include "jostle/stress/collision_moments.hpp"

namespace jostle {

/// A step whose forces are known, before the rods are moved. Holds references.
struct ResolvedStep {
    const State& state;  ///< as the step begins
    const KnownMotion& known;
    const Contacts& contacts;
    const ContactSolution& solution;
    const Domain& domain;
    std::span<const MobileRod> arms;  ///< (n) of the rods of the solution, the axes of their arms
};

/// Fills in the report's stresses, and `moments` if the settings ask for them. `half_way_axis`: scratch.
void measure_stress(const ResolvedStep& step, const SimulationSettings& settings, std::vector<Vec3>& half_way_axis,
                    StepReport& report, CollisionMoments& moments);

}  // namespace jostle
