// One step of the simulation, in the order of docs/theory: read `step`, then the functions that it calls.

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "jostle/contact/gaps_at.hpp"
#include "jostle/contact/reflection.hpp"
#include "jostle/contact/relinearised_contacts.hpp"
#include "jostle/contact/wall_contacts.hpp"
#include "jostle/contact/wca_forces.hpp"
#include "jostle/contact_problem/contact_solver.hpp"
#include "jostle/contact_problem/previous_forces.hpp"
#include "jostle/motion/springs.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/simulation/forces_at_touching.hpp"
#include "jostle/simulation/provisional_change.hpp"
#include "jostle/simulation/reflected_forces.hpp"
#include "jostle/simulation/shearing.hpp"
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

/// How the problem of one step is linearised about its solution: pairs in contact that would overlap by more there (in
/// D) are taken in as they lie there; so often, and no more.
struct Relinearisation {
    double max_overlap;
    int max_times;
};
constexpr Relinearisation where_forces_turn_rods{0.01, 5}, where_noise_does{0.03, 2};

std::size_t contacts_of_all_ranks(const ContactProblem& problem) {
    const auto elsewhere = std::count(problem.is_elsewhere().begin(), problem.is_elsewhere().end(), 1);
    return static_cast<std::size_t>(
        problem.domain().ranks().sum(static_cast<std::int64_t>(problem.size()) - elsewhere));
}

}  // namespace

StepReport Simulation::step() {
    for (;;)
        if (const auto report = attempt()) return *report;
}

/// None if rods of other ranks were not known that have to be, as they are now: nothing has happened.
std::optional<StepReport> Simulation::attempt() {
    StepReport report;
    report.step = state_.clock.step;
    report.time = state_.clock.time;
    PhaseTimer timer(report);
    if (domain_.is_shared())  // whose steps take as long as those of the others
        parallel::suit_thread_count(parallel::worthwhile_thread_count(state_.rods.size()));
    else
        threads_.begin_step(state_.rods.size());
    renumber();
    const BoxColumn opening = opens_box() ? opening_of(state_.box, *settings_.pressure) : BoxColumn{};
    Squeezing squeezing(state_, edges_of_step(), search_);
    report.stretch = squeezing.stretch();
    Shearing shearing(state_, settings_.flow, settings_.time_step, search_);
    Lengthening lengthening(growth_, state_.rods, settings_.time_step);
    const auto mobility = mobility_->at(state_.rods, state_.box);
    if (growth_ || std::exchange(sizes_changed_, false))
        find_size_bounds(state_.rods, domain_, *mobility, settings_, sizes_);
    report.rods = sizes_.rods;

    find_known_motion(state_, motions_, *mobility, context(), known_);  // 1  U_known, and where it takes the rods
    timer.finish(StepPhase::known_velocity);

    const StepGeometry geometry = step_geometry(state_, known_, sizes_, settings_, domain_);
    if (!neighbours_are_known(geometry)) {
        gather(geometry.ranges.skin);
        return std::nullopt;
    }
    Contacts found = std::move(contacts_);
    ids_before_.clear();
    report.max_overlap = search_.find(geometry, found);  // 2  contacts
    report.max_overlap = std::max(report.max_overlap, wall_search_.find(geometry, found));
    report.max_overlap = domain_.ranks().largest(std::max(report.max_overlap, fixed_rod_search_.find(geometry, found)));
    timer.finish(StepPhase::find_contacts);

    ContactProblem problem = posed_problem(*mobility, std::move(found), opening);  // 3  A, b; gamma
    auto solution = settings_.rods_are_soft() ? repelled(problem) : resolved(problem, geometry, report);
    if (!solution) {
        gather(geometry.ranges.skin);
        return std::nullopt;
    }
    solution_ = std::move(*solution);
    report.contacts = contacts_of_all_ranks(problem);
    std::optional<ContactSolution> touching;
    if (mobility->couples_rods() && settings_.corrects_brownian_motion())
        touching = forces_at_touching(problem, solution_, state_.rods, *mobility);
    contacts_ = std::move(problem).take_contacts();
    timer.finish(StepPhase::solve_contacts);
    if (report.status != LcpStatus::converged) return report;  // nothing has happened

    const ResolvedStep step = {state_, known_, contacts_, touching ? *touching : solution_, domain_};
    measure_stress(step, settings_, half_way_axis_, report, moments_);  // 4
    timer.finish(StepPhase::measure_stress);

    if (settings_.pressure && settings_.kT > 0.0) state_.box_force = force_on_box(report, *settings_.pressure);
    squeezing.keep();
    shearing.keep();
    lengthening.keep();
    advance(report);  // 5
    timer.finish(StepPhase::advance);
    if (!domain_.is_shared()) threads_.end_step();
    return report;
}

ContactProblem Simulation::posed_problem(const MobilityOperator& mobility, Contacts found,
                                         const BoxColumn& opening) const {
    std::vector<double> b, start;
    if (!settings_.rods_are_soft()) b = gap_velocities(found);
    if (settings_.warm_start) start = starting_forces(found, state_.rods.id, state_.previous_forces);
    const double compliance = settings_.corrects_brownian_motion() ? contact_compliance : 0.0;
    return ContactProblem(state_.rods, mobility, std::move(found), std::move(b), settings_.time_step, compliance,
                          std::move(start), domain_, opening);
}

// Theory 2.3: 0 <= A gamma + b  perp  gamma >= 0. Of Brownian rods this says where their paths meet others; there they
// are reflected, and what overlaps then is brought back to touching by the same problem (theory, section 3). None if
// rods of other ranks might be near that are not known.
std::optional<ContactSolution> Simulation::resolved(ContactProblem& problem, const StepGeometry& geometry,
                                                    StepReport& report) {
    const auto solver = make_contact_solver(problem, settings_.method, settings_.lcp);
    ContactSolution reflected;
    if (!run_to_solution(*solver, problem, geometry, nullptr)) return std::nullopt;
    if (solver->outcome().status == LcpStatus::converged && settings_.corrects_brownian_motion()) {
        const double strain = settings_.flow ? settings_.flow->strain_of_step(state_.clock, settings_.time_step) : 0.0;
        reflected.gamma =
            reflected_forces(problem, solver->solution(), state_, known_, sizes_.own_mobility, settings_, strain);
        problem.complete(reflected);
        problem.pose_again(gap_velocities_beside(reflected, problem.contacts(), problem.contact_matrix()));
        solver->begin_again();
        if (!run_to_solution(*solver, problem, geometry, &reflected)) return std::nullopt;
    }
    const SolverOutcome& outcome = solver->outcome();
    report.status = outcome.status;
    report.residual = outcome.residual;
    report.iterations = outcome.iterations;
    report.solves = outcome.solves;
    ContactSolution solution = std::move(*solver).take_solution();
    solution.add(reflected);
    return solution;
}

// The contact problem, with more contacts where forces turn out to bring rods together. `acting`: forces that act
// beside those sought, if any. Whether all rods were known that might be among the contacts.
bool Simulation::run_to_solution(ContactSolver& solver, ContactProblem& problem, const StepGeometry& geometry,
                                 const ContactSolution* acting) {
    const bool is_last = acting || !settings_.corrects_brownian_motion();
    const Relinearisation how = settings_.relinearise ? where_forces_turn_rods : where_noise_does;
    int relinearisations = is_last && (settings_.relinearise || acting) ? how.max_times : 0;
    while (solver.run_to_next_stop()) {
        const EndConfiguration end = end_configuration(problem.contact_matrix(), acting, &solver.solution());
        Contacts more;
        if (solver.near_solution() && relinearisations-- > 0)
            more = relinearised(problem, end, solver.solution(), how.max_overlap);
        const auto violated = search_.violated_pairs(geometry, problem.contacts(), end, solver.at_solution());
        if (domain_.ranks().any(search_.lacks_pairs())) return false;
        more.append(search_.activate(violated, geometry));
        more.append(wall_search_.violated(geometry, end));
        more.append(fixed_rod_search_.violated(geometry, end));
        if (more.size() == 0) continue;
        const auto b = acting ? gap_velocities_beside(*acting, more, problem.contact_matrix()) : gap_velocities(more);
        problem.append(more, b);
    }
    return true;
}

// Not in the paper: soft rods. The forces follow from where rods are before the step, and nothing has to be solved.
ContactSolution Simulation::repelled(const ContactProblem& problem) const {
    ContactSolution solution;
    solution.gamma = wca_forces(problem.contacts(), state_.rods, settings_.wca_energy);
    problem.complete(solution);
    return solution;
}

// b of the contact problem (theory, eq. 3.3): the gap after the known motion over dt; or as in the paper,
// b = Phi/dt + D^T U_known.
std::vector<double> Simulation::gap_velocities(const Contacts& contacts) const {
    const double dt = settings_.time_step;
    std::vector<double> b(contacts.size());
    parallel_for(b.size(), [&](std::size_t l) {
        const Contact& contact = contacts.contact[l];
        const bool found_later = contacts.feature[l] == ContactFeature::relinearised || contact.i == contact.j;
        if (settings_.brownian_correction || found_later) {
            b[l] = contact.gap_after / dt;
            return;
        }
        const auto velocity = [&](std::uint32_t body) {
            return is_fixed(body) ? ContactVelocity{}
                                  : ContactVelocity{known_.velocity.linear[body],
                                                    cross(known_.velocity.angular[body], state_.rods.axis[body])};
        };
        b[l] = contact.gap / dt + gap_rate(contact, velocity(contact.i), velocity(contact.j));
    });
    return b;
}

// b where other forces act already: the gap to which they take the rods, over dt.
std::vector<double> Simulation::gap_velocities_beside(const ContactSolution& acting, const Contacts& contacts,
                                                      const ContactMatrix& contact_matrix) {
    std::vector<double> b = gaps_at(contacts, state_.box, end_configuration(contact_matrix, &acting, nullptr));
    parallel_for(b.size(), [&](std::size_t l) {
        if (contacts.feature[l] == ContactFeature::relinearised) b[l] = contacts.contact[l].gap_after;
        b[l] /= settings_.time_step;
    });
    return b;
}

// Theory 2.4: where rods are after the step, and what forces add to the known motion of those with contacts.
EndConfiguration Simulation::end_configuration(const ContactMatrix& contact_matrix, const ContactSolution* acting,
                                               const ContactSolution* solution) {
    const double dt = settings_.time_step;
    const auto rows = contact_matrix.rods();
    by_forces_.resize(rows.size());
    displacement_.resize(rows.size());
    parallel_for(rows.size(), [&](std::size_t k) {
        by_forces_[k] = {};
        for (const ContactSolution* forces : {acting, solution}) {
            if (!forces || k >= forces->velocities.size()) continue;
            by_forces_[k].centre += forces->velocities[k].centre;
            by_forces_[k].axis_rate += forces->velocities[k].axis_rate;
        }
        const auto& [linear, axis_rate] = by_forces_[k];
        const double half = 0.5 * state_.rods.length[rows[k]];
        // Rotations add up to second order in their angles.
        const double twist = half * dt * dt * norm(axis_rate) * norm(known_.velocity.angular[rows[k]]);
        const Vec3 centre = dt * linear, end = (dt * half) * axis_rate;
        const double farthest = farthest_displacement(centre, dt * axis_rate, half) + twist;
        const double rounding = 1e-6 * farthest;
        displacement_[k] = {in_float(centre), in_float(end), static_cast<float>(farthest + rounding),
                            static_cast<float>(twist + rounding)};
    });
    return {state_.rods, known_.velocity, known_.end,   dt, contact_matrix.local_index(),
            rows,        by_forces_,      displacement_};
}

// Not in the paper (theory, eq. 2.18): the problem again, linear about where its solution takes those rods that would
// overlap there.
Contacts Simulation::relinearised(const ContactProblem& problem, const EndConfiguration& end,
                                  const ContactSolution& solution, double max_overlap_per_diameter) const {
    // Beyond what the solver may leave.
    const double tolerance = settings_.lcp.residual == LcpResidual::length ? settings_.lcp.tolerance : 0.0;
    const double max_overlap = max_overlap_per_diameter * sizes_.mean_diameter + tolerance;
    Contacts contacts = relinearised_contacts(problem.contacts(), state_.box, end, max_overlap);
    contacts.append(relinearised_wall_contacts(problem.contacts(), state_.box, end, max_overlap));
    contacts.append(relinearised_fixed_rod_contacts(problem.contacts(), state_.box, end, max_overlap));
    const auto velocity = [&](std::uint32_t body) {
        return is_fixed(body) ? ContactVelocity{} : solution.velocities[end.local_index[body]];
    };
    for (Contact& contact : contacts.contact)
        contact.gap_after -= settings_.time_step * gap_rate(contact, velocity(contact.i), velocity(contact.j));
    return contacts;
}

// Theory 2.4: rods with contacts go where forces take them, the others where the known motion does; then what happens
// between two steps.
void Simulation::advance(StepReport& report) {
    Rods& rods = state_.rods;
    if (growth_) growth_->slow_down(rods, solution_.rods, solution_.forces, settings_.time_step);
    std::vector<Vec3>&centre = known_.end.centre, &axis = known_.end.axis;
    const double dt = settings_.time_step;
    parallel_for(solution_.rods.size(), [&](std::size_t k) {
        const std::uint32_t row = solution_.rods[k];
        centre[row] = centre_at_end(rods, row, known_.velocity, solution_.velocities[k], dt);
        axis[row] = axis_at_end(rods, row, known_.velocity, solution_.velocities[k], dt);
    });
    rods.centre.swap(centre);
    rods.axis.swap(axis);
    if (opens_box()) open_box(report);
    parallel_for(rods.size(), [&](std::size_t i) { state_.box.wrap(rods.centre[i], rods.image[i]); });
    for (const auto& motion : motions_) turn_round(motion->turned_round(rods, context()));
    ++state_.clock.step;
    state_.clock.time = static_cast<double>(state_.clock.step) * settings_.time_step;
    if (growth_) divide();
    if (settings_.warm_start) state_.previous_forces = previous_forces(contacts_, solution_.gamma, contact_ids());
}

// Theory 10: contact forces have opened the box, and the centres go with it.
void Simulation::open_box(StepReport& report) {
    const Vec3 edges = opened(state_.box.edges(), *settings_.pressure, solution_.box_rate, settings_.time_step);
    Squeezing opening(state_, edges, search_);
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
    lineage_ = growth_->divide(state_.rods, state_.box, state_.clock.step, settings_.time_step);
    if (lineage_.empty()) return;
    rows_change();
    ids_before_ = std::move(ids);
}

}  // namespace jostle
