#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "jostle/contact/collision_search.hpp"
#include "jostle/contact_problem/contact_solver.hpp"
#include "jostle/contact_problem/warm_start.hpp"
#include "jostle/growth/growth.hpp"
#include "jostle/mobility/mobility.hpp"
#include "jostle/motion/motion.hpp"
#include "jostle/motion/springs.hpp"
#include "jostle/parallel/thread_choice.hpp"
#include "jostle/rods/box.hpp"
#include "jostle/rods/clock.hpp"
#include "jostle/simulation/step_report.hpp"
#include "jostle/stress/collision_moments.hpp"

namespace jostle {

struct SimulationSettings {
    std::uint64_t seed = 1;
    double time_step = 0.0;
    double kT = 0.0;                  ///< of the Brownian motion; 0 where there is none
    bool brownian_correction = true;  ///< shift, compliance, true gap, moments of the stress (theory, section 3)
    double wca_energy = 0.0;          ///< of the potential that rods repel each other by; 0: they are hard
    double range = 0.0;               ///< contacts with a smaller gap are always taken; 0, or soft: as the step demands
    SolverMethod method = SolverMethod::automatic;
    LcpSettings lcp;                  ///< tolerance as a length
    bool warm_start = false;          ///< the solver begins from the forces of the last step
    bool look_again = false;          ///< no pair in contact may overlap for being turned far in one step
    bool stress_conventions = false;  ///< other conventions of the stress are measured, too
    bool collision_moments = false;   ///< the parts of the collision stress are kept, contact by contact
    std::optional<GrowthLaw> growth;
};

/// Rods in a box, and the step that moves them.
///
/// State (rods, clock, springs, last forces) is apart from settings and results: a simulation made from the state of
/// another goes on bit for bit as that one would have, for any number of threads. Neighbour list and contacts are only
/// a cache. Rows of the rods change now and then, to keep neighbours near each other in memory; ids stay.
class Simulation {
public:
    /// `springs`: between rods that stay, so nothing may grow.
    Simulation(Box box, Rods rods, Clock clock, std::unique_ptr<Mobility> mobility,
               std::vector<std::unique_ptr<Motion>> motions, const SimulationSettings& settings,
               std::vector<Spring> springs = {}, std::vector<LastForce> last_forces = {});

    /// Adds a motion, felt from the next step on, after those that are there.
    void add(std::unique_ptr<Motion> motion) { motions_.push_back(std::move(motion)); }

    /// A step ends unmade, with LcpStatus::interrupted, where `asked` says true while its contact forces are sought.
    void interrupt_when(std::function<bool()> asked) { settings_.lcp.interrupted = std::move(asked); }

    /// Makes one step (step.cpp). Where contacts cannot be resolved the report says so, and rods and clock stay as they
    /// were.
    StepReport step();

    /// Row k of the rods is then what row order[k] was: no result depends on where rods stand. `order`: (N) all rows.
    void reorder(std::span<const std::uint32_t> order);

    const Rods& rods() const { return rods_; }
    const Box& box() const { return box_; }
    const Clock& clock() const { return clock_; }
    /// Between the rods, as they are now.
    std::span<const Spring> springs() const {
        return springs_ ? std::span<const Spring>(springs_->springs()) : std::span<const Spring>();
    }
    /// Who was born and who died after the last step.
    std::span<const LineageEvent> lineage() const { return lineage_; }
    /// The model of the fluid: `at(rods(), box())` is M of the rods as they stand.
    const Mobility& mobility() const { return *mobility_; }
    const SimulationSettings& settings() const { return settings_; }

    /// Of the last step, with the gaps before it.
    const Contacts& contacts() const { return contacts_; }
    const ContactSolution& contact_solution() const { return solution_; }
    /// From which the next step begins; empty unless the settings ask for a warm start.
    std::vector<LastForce> last_forces() const { return warm_start_.forces(); }
    /// The parts of its collision stress, if the settings ask for them.
    const CollisionMoments& collision_moments() const { return moments_; }
    /// Ids of the rows that these refer to: those of `rods()`, but where cells have died, or rows changed, since.
    const std::vector<std::uint64_t>& contact_ids() const { return ids_before_.empty() ? rods_.id : ids_before_; }

private:
    void add_springs(std::vector<Spring> springs);
    void renumber();
    void lengthen();
    void find_known_motion();
    void add_velocities_of_forces(const StepContext& context);
    StepGeometry geometry() const;
    void collide(Contacts found, const StepGeometry& geometry, StepReport& report);
    void repel(Contacts found, StepReport& report);
    void keep(ContactProblem&& problem, ContactSolution solution, StepReport& report);
    void measure_stress(StepReport& report);
    void measure_spring_stress(StepReport& report);
    void advance();
    void turn_round(std::span<const std::uint32_t> rows);
    void divide();

    void take_over_rods();
    void find_sizes();
    void find_mobility();
    void find_search_ranges();
    std::vector<double> gap_velocities(const Contacts& contacts) const;
    EndConfiguration end_configuration(const ContactMatrix& contact_matrix, const ContactSolution& solution);
    Contacts relinearised(const ContactProblem& problem, const ContactSolution& solution,
                          const EndConfiguration& end) const;
    bool corrects_brownian_motion() const { return settings_.brownian_correction && settings_.kT > 0.0; }
    const std::vector<Vec3>& half_way_axes();
    Vec3 turned_by_springs(std::uint32_t row) const;

    Box box_;
    Rods rods_;
    Clock clock_;
    std::unique_ptr<Mobility> mobility_;
    std::unique_ptr<const MobilityOperator> mobility_at_start_;  ///< of the step that is being made
    std::vector<std::unique_ptr<Motion>> motions_;
    SimulationSettings settings_;
    std::optional<Springs> springs_;
    std::optional<Growth> growth_;
    std::vector<LineageEvent> lineage_;
    std::vector<std::uint64_t> ids_before_;  ///< (N) of the rows in the last step, where cells may have died since

    bool reordered_ = false;  ///< rods near each other are near each other in memory
    ThreadChoice threads_;
    CollisionSearch search_;
    bool sizes_changed_ = true;  ///< since the last step
    double mean_diameter_ = 0.0, mean_length_ = 0.0;
    std::vector<RodMobility> own_mobility_;  ///< (N) with the time-step correction
    std::vector<double> largest_shift_;      ///< (N) each rod's part in the shift of a gap, at most
    struct {
        Velocities velocity;               ///< (N) U_known
        Configuration end;                 ///< (N) the rods after it
        std::vector<double> displacement;  ///< (N) by it, of any point of the rod, at most
    } known_;
    std::vector<SpringPull> pulls_;           ///< of the springs
    Velocities by_springs_;                   ///< (N) their part of U_known; (0) without springs
    SearchRanges ranges_;                     ///< of this step
    std::vector<Displacement> displacement_;  ///< (n) of the rods with contacts, by their forces
    std::vector<Vec3> half_way_axis_;         ///< (N) of rods in contact
    Contacts contacts_;
    ContactSolution solution_;
    WarmStart warm_start_;
    CollisionMoments moments_;
};

}  // namespace jostle
