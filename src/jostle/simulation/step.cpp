// One step of the simulation, in the order of docs/theory: read `step`, then the functions that it calls.

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "jostle/motion/springs.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/simulation/contact_resolution.hpp"
#include "jostle/simulation/forces_at_touching.hpp"
#include "jostle/simulation/provisional_change.hpp"
#include "jostle/simulation/simulation.hpp"
#include "jostle/simulation/step_stress.hpp"

namespace jostle {

namespace {

/// Adds the time since the last call to a phase of the report.
class PhaseTimer {
public:
    explicit PhaseTimer(StepReport& report) : report_(report), last_(Clock::now()) {}
    void finish(StepPhase phase) {
        const auto now = Clock::now();
        report_.seconds[static_cast<std::size_t>(phase)] += std::chrono::duration<double>(now - last_).count();
        last_ = now;
    }

private:
    using Clock = std::chrono::steady_clock;
    StepReport& report_;
    Clock::time_point last_;
};

std::size_t contacts_of_all_ranks(const ContactProblem& problem) {
    const auto elsewhere = std::count(problem.is_elsewhere().begin(), problem.is_elsewhere().end(), 1);
    return static_cast<std::size_t>(
        problem.domain().ranks().sum(static_cast<std::int64_t>(problem.size()) - elsewhere));
}

}  // namespace

StepReport Simulation::step() {
    const WorkTimer timer(domain_.ranks(), work_);
    begin_exchanges();
    for (double skins = 1.0;; skins *= 2.0) {  // one does, but where a box changes much
        if (const auto report = attempt()) {
            end_exchanges(timer.seconds());
            return *report;
        }
        gather(skins);
    }
}

/// None if rods have to be gathered first, for some of other ranks are not known that have to be: nothing has happened.
std::optional<StepReport> Simulation::attempt() {
    StepReport report;
    report.step = state_.clock.step;
    report.time = state_.clock.time;
    PhaseTimer timer(report);
    begin_threads();
    renumber();
    const BoxColumn opening = opens_box() ? opening_of(state_.box, *settings_.pressure) : BoxColumn{};
    ProvisionalChanges changes(state_, edges_of_step(report), settings_.flow, growth_, settings_.time_step,
                               searches_.rods);
    report.stretch = changes.stretch();
    const auto mobility = mobility_->at(state_.rods, state_.box);
    update_sizes(*mobility);
    report.rods = sizes_.rods;

    find_known_motion(state_, settings_.has_springs, domain_, motions_, *mobility, context(),
                      known_);  // 1  U_known, and where it takes the rods
    timer.finish(StepPhase::known_velocity);

    const StepGeometry geometry = step_geometry(state_, known_, sizes_, settings_, domain_, previous_forces_in_all_);
    if (!neighbours_are_known(geometry)) return std::nullopt;
    Contacts found = find_contacts(geometry, report);  // 2  contacts
    timer.finish(StepPhase::find_contacts);

    ContactResolution resolution(state_, known_, geometry, sizes_, settings_, domain_, searches_);
    ContactProblem problem = resolution.posed(*mobility, std::move(found), opening);  // 3  A, b; gamma
    std::optional<ContactSolution> solution = resolution.solve(problem, report);
    if (!solution) return std::nullopt;
    report.contacts = contacts_of_all_ranks(problem);
    std::optional<ContactSolution> touching;
    if (mobility->couples_rods() && settings_.corrects_brownian_motion())
        touching = forces_at_touching(problem, *solution, state_.rods, *mobility);
    solution_ = std::move(*solution);
    elsewhere_.assign(problem.is_elsewhere().begin(), problem.is_elsewhere().end());
    contacts_ = std::move(problem).take_contacts();
    timer.finish(StepPhase::solve_contacts);
    if (report.status != LcpStatus::converged) return report;  // nothing has happened

    const ResolvedStep step = {
        state_, known_, contacts_, touching ? *touching : solution_, domain_, problem.matrix().rods()};
    measure_stress(step, settings_, half_way_axis_, report, moments_);  // 4
    timer.finish(StepPhase::measure_stress);

    if (settings_.pressure && !opens_box()) state_.box_force = force_on_box(report);
    changes.keep();
    advance(known_, step.arms, solution_, contacts_, report);  // 5
    timer.finish(StepPhase::advance);
    if (!domain_.is_shared()) threads_.end_step();
    return report;
}

/// As many threads as are worth it; those of ranks, whose steps take as long as those of the others, are not tried.
void Simulation::begin_threads() {
    if (domain_.is_shared())
        parallel::suit_thread_count(parallel::worthwhile_thread_count(state_.rods.size()));
    else
        threads_.begin_step(state_.rods.size());
}

void Simulation::update_sizes(const MobilityOperator& mobility) {
    if (growth_ || std::exchange(sizes_changed_, false))
        find_size_bounds(state_.rods, domain_, mobility, settings_, sizes_);
}

/// In the memory of those of the step before.
Contacts Simulation::find_contacts(const StepGeometry& geometry, StepReport& report) {
    Contacts found = std::move(contacts_);
    ids_before_.clear();
    report.max_overlap = domain_.ranks().largest(searches_.find(geometry, found));
    return found;
}

// Theory 2.4: rods with contacts go where forces take them, the others where the known motion does; then what happens
// between two steps.
void Simulation::advance(KnownMotion& known, std::span<const MobileRod> arms, const ContactSolution& solution,
                         const Contacts& contacts, StepReport& report) {
    Rods& rods = state_.rods;
    if (growth_) {
        growth_->slow_down(rods, solution.rods, solution.forces, settings_.time_step);
        domain_.refresh<double>([&](std::uint32_t row) -> double& { return rods.cycle[row].share; });
    }
    std::vector<Vec3>&centre = known.end.centre, &axis = known.end.axis;
    const double dt = settings_.time_step;
    parallel_for(solution.rods.size(), [&](std::size_t k) {
        const std::uint32_t row = solution.rods[k];
        centre[row] = centre_at_end(rods, row, known.velocity, solution.velocities[k], dt);
        axis[row] = axis_at_end(rods, row, known.velocity, solution.velocities[k], arms[k].axis, dt);
    });
    rods.centre.swap(centre);
    rods.axis.swap(axis);
    if (opens_box()) open_box(solution.box_rate, report);
    parallel_for(rods.size(), [&](std::size_t i) { state_.box.wrap(rods.centre[i], rods.image[i]); });
    for (const auto& motion : motions_) turn_round(motion->turned_round(rods, context()));
    ++state_.clock.step;
    state_.clock.time = static_cast<double>(state_.clock.step) * settings_.time_step;
    if (growth_) divide();
    if (settings_.warm_start) remember_forces(contacts, solution.gamma);
}

// Theory 10: contact forces have opened the box at this rate, and the centres go with it; of a piston the plane alone.
void Simulation::open_box(double rate, StepReport& report) {
    const Vec3 edges = opened(state_.box.edges(), *settings_.pressure, rate, settings_.time_step);
    Squeezing opening(state_, edges, searches_.rods);
    opening.keep();
    for (int k = 0; k < 3; ++k) report.stretch[k] *= opening.stretch()[k];
}

// Theory 2.6: head and tail change names, and no point of a body moves, nor one that a spring holds.
void Simulation::turn_round(std::span<const std::uint32_t> rows) {
    Rods& rods = state_.rods;
    std::vector<std::uint64_t> ids(rows.size());
    parallel_for(rows.size(), [&](std::size_t k) {
        rods.axis[rows[k]] = Vec3{} - rods.axis[rows[k]];  // 0 stays 0, not -0
        ids[k] = rods.id[rows[k]];
    });
    jostle::turn_round(state_.springs, ids);
}

// Theory 5: between two steps cells may divide or die.
void Simulation::divide() {
    lineage_.clear();
    if (!growth_->is_due(state_.clock.step)) return;
    std::vector<std::uint64_t> ids = state_.rods.id;
    lineage_ = domain_.is_shared() ? divide_own()
                                   : growth_->divide(state_.rods, state_.box, state_.clock.step, settings_.time_step);
    if (lineage_.empty()) return;
    rows_change();
    ids_before_ = std::move(ids);
}

}  // namespace jostle
