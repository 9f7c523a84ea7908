// What a step does where several ranks share the rods, beside what it does on one (step.cpp).

#include <algorithm>
#include <array>
#include <string>
#include <unordered_map>
#include <utility>

#include "jostle/contact_problem/previous_forces.hpp"
#include "jostle/domain/between_rods.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/rods/space_filling_order.hpp"
#include "jostle/simulation/simulation.hpp"

namespace jostle {

namespace {

/// Ghosts are sought by so much farther than pairs, which have to be found for all numbers' rounding.
constexpr double beyond_rounding = 1.0 + 1e-6;

void require_ready(bool is_ready, const char* key, const char* problem) {
    if (is_ready) return;
    throw InputError(
        {.key = key, .problem = std::string(problem) + " not ready for several ranks", .suggestion = "Run it on one"});
}

/// Of what every rank has.
template <class Item>
std::vector<Item> share_of(const std::vector<Item>& items, const Ranks& ranks) {
    std::vector<Item> share;
    const auto count = static_cast<std::size_t>(ranks.count());
    for (auto k = static_cast<std::size_t>(ranks.rank()); k < items.size(); k += count) share.push_back(items[k]);
    return share;
}

std::unordered_map<std::uint64_t, std::uint32_t> rows_of(const Rods& rods, std::size_t count) {
    std::unordered_map<std::uint64_t, std::uint32_t> rows;
    for (std::uint32_t row = 0; row < count; ++row) rows[rods.id[row]] = row;
    return rows;
}

}  // namespace

void Simulation::require_ready_for_ranks() const {
    require_ready(!opens_box() || settings_.pressure->moves == PressureControl::Moves::plane, "pressure",
                  "compression without thermal motion is");
    require_ready(settings_.method == SolverMethod::automatic || settings_.method == SolverMethod::projected_sor,
                  "solver.method", "solvers for comparison are");
    require_ready(!mobility_->at(state_.rods, state_.box)->couples_rods(), "fluid", "rods that a fluid couples are");
}

void Simulation::share(const Ranks& ranks) {
    if (ranks.alone()) return;
    require_ready_for_ranks();
    shared_rods_ = state_.rods.size();
    domain_ = Domain(ranks);
    rows_change();
    domain_.share_out(state_.rods);
    std::vector<NumberedSpring> springs;
    for (const Spring& spring : state_.springs) springs.push_back({springs.size(), spring});
    take_springs(std::move(springs));
    state_.previous_forces = share_of(state_.previous_forces, ranks);
    counted_forces_ = state_.previous_forces.size();
    gather(0.0);  // springs need their rods; the first step will ask for neighbours
}

/// Velocities are exchanged once in as many colours as makes the steps of the slowest rank fastest: seldom where few
/// rods wait for messages, and before each colour where contacts that are solved twice would cost more.
void Simulation::begin_exchanges() {
    if (!domain_.is_shared()) return;
    constexpr int most = 16;  // times as often as where it is done most seldom
    settings_.lcp.colours_per_exchange = wanted_colours_per_exchange_;
    if (wanted_colours_per_exchange_ == 0)
        settings_.lcp.colours_per_exchange = static_cast<std::size_t>(most / exchanges_.next(most));
}

void Simulation::end_exchanges(double seconds) {
    if (domain_.is_shared() && wanted_colours_per_exchange_ == 0) exchanges_.took(domain_.ranks().largest(seconds));
}

/// Whether the neighbour list of every rank covers the step, and none is asked for anew.
bool Simulation::neighbours_are_known(const StepGeometry& geometry) {
    if (!domain_.is_shared()) return true;
    skin_ = geometry.ranges.skin;
    const bool is_covered = searches_.rods.is_covered(geometry);
    return !domain_.ranks().any(gathering_ || !is_covered);
}

/// Rods change their rank, and neighbours are listed anew, as far as any rank needs them and so many skins farther.
void Simulation::gather(double skins) {
    const Ranks& ranks = domain_.ranks();
    const double range = 2.0 * (ranks.largest(searches_.rods.range_needed()) + skins * skin_);
    rows_change();
    std::vector<NumberedSpring> springs = counted_springs();
    const std::size_t owned = domain_.owned_of(state_.rods.size());
    const bool balance = ranks.any(balance_) || work_.is_uneven(ranks);
    domain_.migrate(state_.rods, state_.box, balance, work_.of_rod(ranks, owned));
    if (balance) work_ = {};
    if (settings_.has_springs) gather_springs(springs);
    domain_.fetch_ghosts(state_.rods, state_.box, beyond_rounding * range, rods_held_elsewhere());
    NeighbourList& neighbours = searches_.rods.neighbours();
    const std::size_t own = domain_.owned_of(state_.rods.size());
    neighbours.build_of_own(state_.rods, state_.box, range, own);
    const auto rows = with_held_rods(neighbours.rows_with_pairs(own));
    neighbours.keep(rows);
    domain_.keep(state_.rods, rows);
    if (settings_.warm_start) gather_forces();
    balance_ = gathering_ = false;
}

/// The forces of the step before come to the ranks that have their rods.
void Simulation::gather_forces() {
    BetweenRods<PreviousForce> here = at_ranks_of_rods(
        domain_, state_.rods, std::span<const PreviousForce>(state_.previous_forces).first(counted_forces_),
        [](const PreviousForce& force) {
            return std::array{force.i, force.j};
        });
    state_.previous_forces = std::move(here.items);
    counted_forces_ = here.counted;
}

/// Own cells divide and die; ghosts are left if any cell has, of any rank. Returns what all ranks will tell.
std::vector<LineageEvent> Simulation::divide_own() {
    const Ranks& ranks = domain_.ranks();
    Rods own = domain_.own_rods(state_.rods);
    std::vector<LineageEvent> events =
        ranks.gather_at_all(growth_->divide(own, state_.box, state_.clock.step, settings_.time_step));
    if (events.empty()) return events;
    std::sort(events.begin(), events.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    domain_.replace(state_.rods, std::move(own));
    shared_rods_ = static_cast<std::size_t>(ranks.sum(static_cast<std::int64_t>(state_.rods.size())));
    return events;
}

/// Those that this rank counts, and then those that another one does.
void Simulation::remember_forces(const Contacts& contacts, std::span<const double> gamma) {
    std::vector<PreviousForce>& forces = state_.previous_forces;
    if (!domain_.is_shared()) {
        forces = previous_forces(contacts, gamma, contact_ids());
        previous_forces_in_all_ = counted_forces_ = forces.size();
        return;
    }
    std::vector<double> counted(gamma.begin(), gamma.end()), others = counted;
    for (std::size_t l = 0; l < gamma.size(); ++l) (counts(l) ? others : counted)[l] = 0.0;
    forces = previous_forces(contacts, counted, contact_ids());
    counted_forces_ = forces.size();
    previous_forces_in_all_ = static_cast<std::size_t>(domain_.ranks().sum(static_cast<std::int64_t>(counted_forces_)));
    const std::vector<PreviousForce> of_others = previous_forces(contacts, others, contact_ids());
    forces.insert(forces.end(), of_others.begin(), of_others.end());
}

/// Those whose first rod is this rank's own.
std::vector<Simulation::NumberedSpring> Simulation::counted_springs() const {
    std::vector<NumberedSpring> counted;
    if (!settings_.has_springs) return counted;
    const auto own = rows_of(state_.rods, domain_.owned_of(state_.rods.size()));
    for (std::size_t l = 0; l < state_.springs.size(); ++l)
        if (own.contains(state_.springs[l].rod_1)) counted.push_back({spring_numbers_[l], state_.springs[l]});
    return counted;
}

/// Springs of all ranks come to the ranks that have their rods.
void Simulation::gather_springs(std::span<const NumberedSpring> counted) {
    take_springs(at_ranks_of_rods(domain_, state_.rods, counted, [](const NumberedSpring& numbered) {
                     return std::array{numbered.spring.rod_1, numbered.spring.rod_2};
                 }).items);
}

/// Keeps those that hold a rod of this rank, in the order of their numbers.
void Simulation::take_springs(std::vector<NumberedSpring> springs) {
    const auto own = rows_of(state_.rods, domain_.owned_of(state_.rods.size()));
    std::erase_if(springs, [&](const NumberedSpring& numbered) {
        return !own.contains(numbered.spring.rod_1) && !own.contains(numbered.spring.rod_2);
    });
    std::sort(springs.begin(), springs.end(),
              [](const NumberedSpring& a, const NumberedSpring& b) { return a.number < b.number; });
    state_.springs.clear();
    spring_numbers_.clear();
    for (const NumberedSpring& numbered : springs) {
        state_.springs.push_back(numbered.spring);
        spring_numbers_.push_back(numbered.number);
    }
}

/// Own rods at springs whose other rod another rank has, before ghosts are fetched.
std::vector<Domain::Wanted> Simulation::rods_held_elsewhere() const {
    std::vector<Domain::Wanted> wanted;
    if (!settings_.has_springs) return wanted;
    const auto own = rows_of(state_.rods, state_.rods.size());
    std::vector<std::uint64_t> others;
    for (const Spring& spring : state_.springs)
        for (const auto& [id, other] : {std::pair(spring.rod_1, spring.rod_2), {spring.rod_2, spring.rod_1}}) {
            if (own.contains(other)) continue;
            wanted.push_back({own.at(id), Domain::nobody});
            others.push_back(other);
        }
    const std::vector<int> ranks = domain_.ranks_of(state_.rods, others);
    for (std::size_t k = 0; k < ranks.size(); ++k) wanted[k].rank = ranks[k];
    return wanted;
}

/// These rows, and those of rods that springs hold, ascending.
std::vector<std::uint32_t> Simulation::with_held_rods(std::vector<std::uint32_t> rows) const {
    if (!settings_.has_springs) return rows;
    const auto all = rows_of(state_.rods, state_.rods.size());
    for (const Spring& spring : state_.springs)
        for (const std::uint64_t id : {spring.rod_1, spring.rod_2}) rows.push_back(all.at(id));
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    return rows;
}

State Simulation::state_without_rods() const {
    State state = {state_.box, {}, state_.clock, state_.springs, state_.previous_forces, state_.box_force};
    if (domain_.is_shared()) {
        const auto counted = state_.previous_forces.begin() + static_cast<std::ptrdiff_t>(counted_forces_);
        state.previous_forces = domain_.ranks().gather_at_first(std::vector(state_.previous_forces.begin(), counted));
        std::vector<NumberedSpring> springs = domain_.ranks().gather_at_first(counted_springs());
        std::sort(springs.begin(), springs.end(),
                  [](const NumberedSpring& a, const NumberedSpring& b) { return a.number < b.number; });
        state.springs.clear();
        for (const NumberedSpring& numbered : springs) state.springs.push_back(numbered.spring);
    }
    sort_by_ids(state.previous_forces);
    return state;
}

void Simulation::unite() {
    searches_ = ContactSearches();
    known_ = KnownMotion();
    half_way_axis_ = std::vector<Vec3>();
    if (!domain_.is_shared()) return;
    State whole = state_without_rods();
    whole.rods = rods_in_order().whole();
    rows_change();
    state_ = std::move(whole);
    domain_ = Domain();
}

Rods Simulation::rods_of_all_ranks() const {
    return in_order_of_ids(domain_.all_rods(state_.rods));
}

}  // namespace jostle
