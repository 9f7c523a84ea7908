#pragma once

#include <cstdint>
#include <optional>

#include "jostle/contact_problem/solver_method.hpp"
#include "jostle/growth/growth_law.hpp"
#include "jostle/lcp/lcp_problem.hpp"
#include "jostle/motion/shear_flow.hpp"
#include "jostle/simulation/box_strain.hpp"
#include "jostle/simulation/conditions.hpp"

namespace jostle {

/// What a step needs of a scene.
struct SimulationSettings {
    std::uint64_t seed = 1;
    double time_step = 0.0;
    double kT = 0.0;                  ///< of the Brownian motion in the last step; 0 where there is none
    bool brownian_correction = true;  ///< reflected steps, true gaps, moments of the stress (theory, section 3)
    double wca_energy = 0.0;          ///< of the potential that rods repel each other by; 0: they are hard
    double range = 0.0;               ///< contacts with a smaller gap are always taken; 0, or soft: as the step demands
    SolverMethod method = SolverMethod::automatic;
    LcpSettings lcp;                  ///< tolerance as a length
    bool warm_start = false;          ///< the solver begins from the forces of the step before
    bool relinearise = false;         ///< no pair in contact may overlap for being turned far in one step
    bool stress_conventions = false;  ///< other conventions of the stress are measured, too
    bool collision_moments = false;   ///< the parts of the collision stress are kept, contact by contact
    std::optional<ShearFlow> flow;    ///< that the rods go with; steps shear a box that is periodic along x and y
    std::optional<GrowthLaw> growth;
    bool has_springs = false;  ///< between any rods; as the simulation finds them in its state
    Schedule schedule = {};
    std::optional<PressureControl> pressure;  ///< without it the box stays, but for a schedule

    bool rods_are_soft() const { return wca_energy > 0.0; }
    /// Steps are reflected where rods meet.
    bool corrects_brownian_motion() const { return brownian_correction && kT > 0.0; }
};

}  // namespace jostle
