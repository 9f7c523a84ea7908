#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "jostle/contact_problem/contact_solution.hpp"
#include "jostle/domain/domain.hpp"
#include "jostle/domain/rods_in_order.hpp"
#include "jostle/growth/growth.hpp"
#include "jostle/parallel/thread_choice.hpp"
#include "jostle/simulation/contact_searches.hpp"
#include "jostle/simulation/known_motion.hpp"
#include "jostle/simulation/simulation_settings.hpp"
#include "jostle/simulation/size_bounds.hpp"
#include "jostle/simulation/step_report.hpp"
#include "jostle/simulation/work.hpp"
#include "jostle/state/state.hpp"
#include "jostle/stress/collision_moments.hpp"

namespace jostle {

/// Rods in a box, and the step that moves them.
///
/// State is apart from settings and results: a simulation made from the state of another goes on bit for bit as that
/// one would have, for any number of threads. Neighbour list and contacts are only a cache. Rows of the rods change now
/// and then, to keep neighbours near each other in memory; ids stay.
class Simulation {
public:
    /// Errors: InputError for springs that are none, or between rods that grow.
    Simulation(State state, std::unique_ptr<Mobility> mobility, std::vector<std::unique_ptr<Motion>> motions,
               const SimulationSettings& settings);

    /// Adds a motion, felt from the next step on, after those that are there.
    void add(std::unique_ptr<Motion> motion) { motions_.push_back(std::move(motion)); }

    /// A step ends unmade, with LcpStatus::interrupted, where `asked` says true while its contact forces are sought.
    void interrupt_when(std::function<bool()> asked) { settings_.lcp.interrupted = std::move(asked); }

    /// Makes this the part of one simulation that the calling rank has: all ranks have made it from the same state, and
    /// each keeps its share of the rods. Whatever a step reports is then of all ranks, and what they do has the same
    /// bits as without them; `rods()` are those of this rank, of which `domain()` knows the own ones. To be called
    /// before the first step, as all that follows, by all ranks together. Errors: InputError for what is not ready for
    /// several ranks.
    void share(const Ranks& ranks);
    /// Refuses what `share` refuses, and changes nothing.
    void require_ready_for_ranks() const;
    const Domain& domain() const { return domain_; }
    /// How many rods all ranks have together.
    std::size_t rods_in_all() const { return domain_.is_shared() ? shared_rods_ : state_.rods.size(); }
    /// The state of all ranks but for their rods, its forces in the order of ids, for rank 0.
    State state_without_rods() const;
    /// The rods of all ranks, for a file.
    RodsInOrder rods_in_order(RodsInOrder::TakenBy taken_by = RodsInOrder::TakenBy::first_rank) const {
        return {state_.rods, domain_, taken_by};
    }
    /// Ends what `share` has begun: rank 0 has all rods, and the others none, from here on each on its own. Gives back
    /// the memory that is kept for speed, also of one process.
    void unite();
    /// The rods of all ranks, in the order of ids: for tests and small systems.
    Rods rods_of_all_ranks() const;
    /// At the beginning of the next step rods may change their rank, for cuts that give all ranks the same work.
    void rebalance() { balance_ = gathering_ = true; }

    /// Ranks exchange velocities once in so many colours of a sweep; 0, as is the default: as often as makes steps
    /// fastest. No bit depends on it.
    void exchange_once_in(std::size_t colours) { wanted_colours_per_exchange_ = colours; }
    std::size_t colours_per_exchange() const { return settings_.lcp.colours_per_exchange; }

    /// Makes one step (step.cpp). Where contacts cannot be resolved the report says so, and the state stays as it was.
    StepReport step();

    /// Row k of the rods is then what row order[k] was: no result depends on where rods stand. `order`: (N) all rows.
    void reorder(std::span<const std::uint32_t> order);

    const State& state() const { return state_; }
    const Rods& rods() const { return state_.rods; }
    const Box& box() const { return state_.box; }
    const Clock& clock() const { return state_.clock; }
    /// Whether the rods come to equilibrium, but for springs: they are thermal, none grows, no motion drives them.
    bool keeps_equilibrium() const;
    /// Who was born and who died after the last step, of all ranks.
    std::span<const LineageEvent> lineage() const { return lineage_; }
    /// The model of the fluid: `at(rods(), box())` is M of the rods as they stand.
    const Mobility& mobility() const { return *mobility_; }
    const SimulationSettings& settings() const { return settings_; }

    /// Of the last step, with the gaps before it.
    const Contacts& contacts() const { return contacts_; }
    const ContactSolution& contact_solution() const { return solution_; }
    /// Whether this rank counts the contact: of two ranks that have it one does.
    bool counts(std::size_t contact) const { return elsewhere_.empty() || elsewhere_[contact] == 0; }
    /// The parts of its collision stress, if the settings ask for them.
    const CollisionMoments& collision_moments() const { return moments_; }
    /// Ids of the rows that these refer to: those of `rods()`, but where cells have died, or rows changed, since.
    const std::vector<std::uint64_t>& contact_ids() const { return ids_before_.empty() ? state_.rods.id : ids_before_; }

private:
    /// A spring, and its number among those of all ranks: by these forces of springs are added up.
    struct NumberedSpring {
        std::uint64_t number;
        Spring spring;
    };

    std::optional<StepReport> attempt();
    bool neighbours_are_known(const StepGeometry& geometry);
    void gather(double skins);
    void gather_forces();
    std::vector<NumberedSpring> counted_springs() const;
    void take_springs(std::vector<NumberedSpring> springs);
    void gather_springs(std::span<const NumberedSpring> counted);
    std::vector<std::uint32_t> with_held_rods(std::vector<std::uint32_t> rows) const;
    std::vector<Domain::Wanted> rods_held_elsewhere() const;
    void remember_forces(const Contacts& contacts, std::span<const double> gamma);
    std::optional<Vec3> follow_schedule();
    std::optional<Vec3> edges_of_step(StepReport& report);
    void renumber();
    void rows_change();
    void update_sizes(const MobilityOperator& mobility);
    Contacts find_contacts(const StepGeometry& geometry, StepReport& report);
    void advance(KnownMotion& known, std::span<const MobileRod> arms, const ContactSolution& solution,
                 const Contacts& contacts, StepReport& report);
    void open_box(double rate, StepReport& report);
    /// Whether contact forces do, in the step in which they act.
    bool opens_box() const { return opens_in_step(settings_.pressure, settings_.kT); }
    void turn_round(std::span<const std::uint32_t> rows);
    void divide();
    std::vector<LineageEvent> divide_own();
    void begin_threads();
    void begin_exchanges();
    void end_exchanges(double seconds);
    StepContext context() const { return {settings_.seed, state_.clock.step, settings_.time_step}; }

    State state_;
    std::unique_ptr<Mobility> mobility_;
    std::vector<std::unique_ptr<Motion>> motions_;
    std::size_t scheduled_motions_;  ///< those that a schedule replaces, before those that were added
    std::optional<Growth> growth_;
    SimulationSettings settings_;
    Domain domain_;
    std::size_t shared_rods_ = 0;
    bool balance_ = false, gathering_ = false;  ///< when neighbours are listed next; in the next step
    Work work_;
    std::size_t wanted_colours_per_exchange_ = 0;
    ChoiceByTime exchanges_;
    double skin_ = 0.0;               ///< of the step that found its neighbours not known
    std::size_t counted_forces_ = 0;  ///< previous forces that this rank counts: the first ones
    std::size_t previous_forces_in_all_ = 0;
    std::vector<std::uint64_t> spring_numbers_;  ///< of the springs, ascending, where ranks share them

    // Results of the last step.
    std::vector<LineageEvent> lineage_;
    Contacts contacts_;
    std::vector<std::uint8_t> elsewhere_;  ///< (contacts) whether another rank counts it; (0) of one process
    ContactSolution solution_;
    CollisionMoments moments_;
    std::vector<std::uint64_t> ids_before_;  ///< (N) of the rows in that step, if rows have changed since

    // Kept from step to step for their memory, or for speed: dropping them changes no bit.
    ThreadChoice threads_;
    bool reordered_ = false;  ///< rods near each other are near each other in memory
    ContactSearches searches_;
    bool sizes_changed_ = true;  ///< since `sizes_` were found
    SizeBounds sizes_;
    KnownMotion known_;
    std::vector<Vec3> half_way_axis_;  ///< (N)
};

}  // namespace jostle
