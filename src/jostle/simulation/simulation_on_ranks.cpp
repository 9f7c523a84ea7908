// What a step does where several ranks share the rods, beside what it does on one (step.cpp).

#include <string>
#include <utility>

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

}  // namespace

void Simulation::require_ready_for_ranks() const {
    require_ready(!growth_, "growth", "cells that grow are");
    require_ready(state_.springs.empty(), "springs", "springs are");
    require_ready(!settings_.schedule, "schedule", "a schedule is");
    require_ready(!settings_.pressure, "pressure", "a bath of pressure is");
    require_ready(!settings_.flow, "flow", "a flow is");
    require_ready(!settings_.warm_start, "solver.warm_start", "steps that begin from the forces of the last are");
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
}

/// Whether the neighbour list of every rank covers the step, and none is asked for anew.
bool Simulation::neighbours_are_known(const StepGeometry& geometry) {
    if (!domain_.is_shared()) return true;
    const bool is_covered = searches_.rods.is_covered(geometry);
    return !domain_.ranks().any(gathering_ || !is_covered);
}

/// Rods change their rank, and neighbours are listed anew, as far as any rank needs them.
void Simulation::gather(double skin) {
    const Ranks& ranks = domain_.ranks();
    const double range = 2.0 * (ranks.largest(searches_.rods.range_needed()) + skin);
    rows_change();
    domain_.gather(state_.rods, state_.box, beyond_rounding * range,
                   ranks.any(balance_) || domain_.is_uneven(state_.rods));
    NeighbourList& neighbours = searches_.rods.neighbours();
    const std::size_t own = domain_.owned_of(state_.rods.size());
    neighbours.build_of_own(state_.rods, state_.box, range, own);
    const auto rows = neighbours.rows_with_pairs(own);
    neighbours.keep(rows);
    domain_.keep(state_.rods, rows);
    balance_ = gathering_ = false;
}

State Simulation::whole_state() const {
    if (!domain_.is_shared()) return in_order_of_ids(state_);
    State whole = {state_.box, domain_.at_first_rank(state_.rods), state_.clock};
    whole.box_force = state_.box_force;
    return whole;
}

void Simulation::unite() {
    if (!domain_.is_shared()) return;
    Rods all = domain_.at_first_rank(state_.rods);
    rows_change();
    state_.rods = std::move(all);
    domain_ = Domain();
}

Rods Simulation::rods_of_all_ranks() const {
    return in_order_of_ids(domain_.all_rods(state_.rods));
}

}  // namespace jostle
