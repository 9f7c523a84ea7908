// What a step does where several ranks share the rods, beside what it does on one (step.cpp).

#include <array>
#include <string>
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

}  // namespace

void Simulation::require_ready_for_ranks() const {
    require_ready(!growth_, "growth", "cells that grow are");
    require_ready(state_.springs.empty(), "springs", "springs are");
    require_ready(!opens_box(), "pressure", "compression without thermal motion is");
    require_ready(!settings_.flow, "flow", "a flow is");
    require_ready(state_.box.offset() == 0.0, "box", "a sheared box is");
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
    state_.previous_forces = share_of(state_.previous_forces, ranks);
    counted_forces_ = state_.previous_forces.size();
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
    domain_.gather(state_.rods, state_.box, beyond_rounding * range,
                   ranks.any(balance_) || domain_.is_uneven(state_.rods));
    NeighbourList& neighbours = searches_.rods.neighbours();
    const std::size_t own = domain_.owned_of(state_.rods.size());
    neighbours.build_of_own(state_.rods, state_.box, range, own);
    const auto rows = neighbours.rows_with_pairs(own);
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

State Simulation::whole_state() const {
    if (!domain_.is_shared()) return in_order_of_ids(state_);
    State whole = {state_.box, domain_.at_first_rank(state_.rods), state_.clock};
    whole.box_force = state_.box_force;
    const auto counted = state_.previous_forces.begin() + static_cast<std::ptrdiff_t>(counted_forces_);
    whole.previous_forces = domain_.ranks().gather_at_first(std::vector(state_.previous_forces.begin(), counted));
    return in_order_of_ids(whole);
}

void Simulation::unite() {
    if (!domain_.is_shared()) return;
    State whole = whole_state();
    rows_change();
    state_ = std::move(whole);
    domain_ = Domain();
}

Rods Simulation::rods_of_all_ranks() const {
    return in_order_of_ids(domain_.all_rods(state_.rods));
}

}  // namespace jostle
