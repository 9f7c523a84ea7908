#pragma once

#include <array>
#include <cstdint>

#include "jostle/lcp/lcp_problem.hpp"
#include "jostle/math/mat3.hpp"
#include "jostle/rods/wall.hpp"

namespace jostle {

/// The parts of a step, in their order: the names of the timers, of the benchmark's columns and of the theory's
/// sections.
enum class StepPhase { known_velocity, find_contacts, solve_contacts, measure_stress, advance };
inline constexpr std::size_t step_phase_count = 5;
inline constexpr std::array<const char*, step_phase_count> step_phase_names = {
    "known_velocity", "find_contacts", "solve_contacts", "measure_stress", "advance"};

/// What happened in one step; the results, apart from the state that the step left.
struct StepReport {
    std::uint64_t step = 0;                   ///< number of the step; its forces act from `time` to `time` + dt
    double time = 0.0;                        ///< when it began
    std::size_t rods = 0;                     ///< in the step
    LcpStatus status = LcpStatus::converged;  ///< if not converged, the rods have not been moved
    double residual = 0.0;         ///< of the contact problem, in the chosen measure (a length, or the paper's norm)
    std::uint64_t iterations = 0;  ///< sweeps, or applications of A
    std::uint64_t solves = 0;      ///< 1, or more where collisions reached beyond the first set of contacts
    std::size_t contacts = 0;
    std::size_t active_contacts = 0;  ///< with gamma > 0
    double max_overlap = 0.0;  ///< largest of two rods, or of a rod and a wall, when the step began, after growth and
                               ///< squeezing; a length
    std::array<double, max_walls> wall_force{};  ///< on each wall by its number: sum of its contact forces
    Vec3 fixed_rod_force;                        ///< on all fixed rods together
    Vec3 stretch{1, 1, 1};       ///< of the box in the step, and of the centres with it: edges after over before
    bool box_held_back = false;  ///< a bath of pressure would have moved the box by more than a step may
    double lacking_edge = 0.0;   ///< by so much a bath has made an edge shorter than rods need beside their own images
    Mat3 collision_virial;       ///< sum over contacts of theory, eq. (1.1): V times the collision stress
    Mat3 spring_virial;          ///< the same of springs (theory, eq. 1.16); 0 where there are none
    Mat3 torque_virial;          ///< of torques that motions exert (theory, eq. 1.22); 0 where there are none
    /// The collision stress in other conventions, if asked for: the sums over contacts of (r_j - r_i) F, centre of mass
    /// to centre of mass, and of (r_j + a_j - r_i - a_i) F, from centre line to centre line.
    Mat3 centre_of_mass_virial, centre_line_virial;
    std::array<double, step_phase_count> seconds{};
};

}  // namespace jostle
