// One step of the simulation, in the order of docs/theory: read `step`, then the functions that it calls.

#include <chrono>
#include <optional>

#include "jostle/contact/relinearised_contacts.hpp"
#include "jostle/contact/wca_forces.hpp"
#include "jostle/contact_problem/contact_solver.hpp"
#include "jostle/math/rotation.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/simulation/simulation.hpp"
#include "jostle/stress/collision_stress.hpp"
#include "jostle/stress/spring_stress.hpp"

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

/// Cells that lengthen in a step: where it fails they have not.
class Lengthening {
public:
    explicit Lengthening(Rods& rods) : rods_(rods), before_(rods.length) {}
    Lengthening(const Lengthening&) = delete;
    Lengthening& operator=(const Lengthening&) = delete;
    ~Lengthening() {
        if (!kept_) rods_.length.swap(before_);
    }
    void keep() { kept_ = true; }

private:
    Rods& rods_;
    std::vector<double> before_;
    bool kept_ = false;
};

/// Pairs in contact may overlap by as much, in D, where contact forces turn them far in one step.
constexpr double max_overlap_of_turning = 0.01;
/// So often, and no more, is the problem of one step linearised about its solution.
constexpr int max_relinearisations = 5;

}  // namespace

StepReport Simulation::step() {
    StepReport report;
    report.step = clock_.step;
    report.time = clock_.time;
    report.rods = rods_.size();
    PhaseTimer timer(report);

    threads_.begin_step(rods_.size());
    renumber();
    std::optional<Lengthening> lengthening;
    if (growth_) {
        lengthening.emplace(rods_);
        lengthen();
    }
    find_mobility();
    find_known_motion();
    timer.finish(StepPhase::known_velocity);
    const StepGeometry geometry = this->geometry();
    Contacts found = std::move(contacts_);
    report.max_overlap = search_.find(geometry, found);
    timer.finish(StepPhase::find_contacts);
    ids_before_.clear();
    settings_.wca_energy > 0.0 ? repel(std::move(found), report) : collide(std::move(found), geometry, report);
    timer.finish(StepPhase::solve_contacts);
    if (report.status != LcpStatus::converged) return report;
    measure_spring_stress(report);
    measure_stress(report);
    if (growth_) growth_->slow_down(rods_, solution_.rods, solution_.forces, settings_.time_step);
    timer.finish(StepPhase::measure_stress);
    advance();
    if (growth_) {
        lengthening->keep();
        divide();
    }
    if (settings_.warm_start) warm_start_.keep(contacts_, solution_.gamma, contact_ids());
    timer.finish(StepPhase::advance);
    threads_.end_step();
    return report;
}

// Theory 5: growth closes gaps, and the contact problem of the same step opens them.
void Simulation::lengthen() {
    growth_->lengthen(rods_, settings_.time_step);
    find_sizes();
}

// Theory 2.1: U_known, the sum of all motions, and where it would take the rods.
void Simulation::find_known_motion() {
    auto& [linear, angular] = known_.velocity;
    parallel_for(rods_.size(), [&](std::size_t i) { linear[i] = angular[i] = Vec3{}; });
    const StepContext context{settings_.seed, clock_.step, settings_.time_step};
    for (const auto& cause : motions_) cause->add_velocities(known_.velocity, rods_, *mobility_at_start_, context);
    add_velocities_of_forces(context);
    parallel_for(rods_.size(), [&](std::size_t i) {
        auto& [centre, axis] = known_.end;
        centre[i] = rods_.centre[i] + settings_.time_step * linear[i];
        axis[i] = rotated(rods_.axis[i], settings_.time_step * angular[i]);
        known_.displacement[i] =
            farthest_displacement(centre[i] - rods_.centre[i], axis[i] - rods_.axis[i], 0.5 * rods_.length[i]);
    });
    find_search_ranges();
}

// M is applied once to the sum of the motions' forces; and to those of springs, whose velocities their stress needs
// (theory 2.7).
void Simulation::add_velocities_of_forces(const StepContext& context) {
    const auto add = [&](const Velocities& velocities) {
        parallel_for(rods_.size(), [&](std::size_t i) {
            known_.velocity.linear[i] += velocities.linear[i];
            known_.velocity.angular[i] += velocities.angular[i];
        });
    };
    if (const auto forces = sum_of_forces(motions_, rods_, context)) {
        Velocities velocities;
        mobility_at_start_->apply(*forces, velocities);
        add(velocities);
    }
    if (!springs_) return;
    pulls_ = springs_->pulls(rods_, box_);
    mobility_at_start_->apply(springs_->forces(rods_, pulls_), by_springs_);
    add(by_springs_);
}

// Theory 2.2: what the search for contacts needs to know of the step.
StepGeometry Simulation::geometry() const {
    const bool corrected = corrects_brownian_motion();
    const GapShift shift = {largest_shift_, rods_.axis,
                            corrected ? std::span(own_mobility_) : std::span<const RodMobility>{}, settings_.kT,
                            settings_.time_step};
    return {rods_, box_, known_.end, known_.displacement, shift, ranges_, settings_.wca_energy > 0.0};
}

// Theory 2.3: 0 <= A gamma + b  perp  gamma >= 0, with more contacts where forces turn out to bring rods together.
void Simulation::collide(Contacts found, const StepGeometry& geometry, StepReport& report) {
    const double compliance = corrects_brownian_motion() ? contact_compliance : 0.0;
    std::vector<double> b = gap_velocities(found), start;
    if (settings_.warm_start) start = warm_start_.guess(found, rods_.id);
    ContactProblem problem(rods_, *mobility_at_start_, std::move(found), std::move(b), settings_.time_step, compliance,
                           std::move(start));
    const auto solver = make_contact_solver(problem, settings_.method, settings_.lcp);
    int relinearisations = settings_.look_again ? max_relinearisations : 0;
    while (solver->run_to_next_stop()) {
        const ContactSolution& solution = solver->solution();
        const EndConfiguration end = end_configuration(problem.contact_matrix(), solution);
        Contacts more;
        if (solver->at_solution() && relinearisations-- > 0) more = relinearised(problem, solution, end);
        const auto violated = search_.violated_pairs(geometry, problem.contacts(), end, solver->at_solution());
        more.append(search_.activate(violated, geometry));
        if (more.size() > 0) problem.append(more, gap_velocities(more));
    }
    const SolverOutcome& outcome = solver->outcome();
    report.status = outcome.status;
    report.residual = outcome.residual;
    report.iterations = outcome.iterations;
    report.solves = outcome.solves;
    keep(std::move(problem), std::move(*solver).take_solution(), report);
}

// Not in the paper: soft rods. The forces follow from where rods are before the step, and nothing has to be solved.
void Simulation::repel(Contacts found, StepReport& report) {
    ContactSolution solution;
    solution.gamma = wca_forces(found, rods_, settings_.wca_energy);
    ContactProblem problem(rods_, *mobility_at_start_, std::move(found), {}, settings_.time_step);
    problem.complete(solution);
    keep(std::move(problem), std::move(solution), report);
}

void Simulation::keep(ContactProblem&& problem, ContactSolution solution, StepReport& report) {
    contacts_ = std::move(problem).take_contacts();
    solution_ = std::move(solution);
    report.contacts = contacts_.size();
}

// b of the contact problem (theory, eq. 3.3): the gap after the known motion, shifted, over dt; or as in the paper,
// b = Phi/dt + D^T U_known.
std::vector<double> Simulation::gap_velocities(const Contacts& contacts) const {
    const double dt = settings_.time_step;
    std::vector<double> b(contacts.size());
    parallel_for(b.size(), [&](std::size_t l) {
        const Contact& contact = contacts.contact[l];
        const bool found_later = contacts.feature[l] == ContactFeature::relinearised || contact.i == contact.j;
        if (settings_.brownian_correction || found_later) {
            b[l] = contact.shifted_gap / dt;
            return;
        }
        const auto velocity = [&](std::uint32_t row) {
            return ContactVelocity{known_.velocity.linear[row], cross(known_.velocity.angular[row], rods_.axis[row])};
        };
        b[l] = contact.gap / dt + gap_rate(contact, velocity(contact.i), velocity(contact.j));
    });
    return b;
}

// Theory 2.4: where rods are after the step, and what forces add to the known motion of those with contacts.
EndConfiguration Simulation::end_configuration(const ContactMatrix& contact_matrix, const ContactSolution& solution) {
    const double dt = settings_.time_step;
    const auto rows = contact_matrix.rods();
    displacement_.resize(rows.size());
    parallel_for(rows.size(), [&](std::size_t k) {
        const auto& [linear, turning] = solution.velocities[k];
        const double half = 0.5 * rods_.length[rows[k]];
        // Rotations add up to second order in their angles.
        const double twist = half * dt * dt * norm(turning) * norm(known_.velocity.angular[rows[k]]);
        const Vec3 centre = dt * linear, end = (dt * half) * turning;
        const double farthest = farthest_displacement(centre, dt * turning, half) + twist;
        const double rounding = 1e-6 * farthest;
        displacement_[k] = {in_float(centre), in_float(end), static_cast<float>(farthest + rounding),
                            static_cast<float>(twist + rounding)};
    });
    return {rods_, known_.velocity,     known_.end,   dt, contact_matrix.local_index(),
            rows,  solution.velocities, displacement_};
}

// Not in the paper (theory, eq. 2.18): the problem again, linear about where its solution takes those rods that would
// overlap there.
Contacts Simulation::relinearised(const ContactProblem& problem, const ContactSolution& solution,
                                  const EndConfiguration& end) const {
    // Beyond what the solver may leave.
    const double tolerance = settings_.lcp.residual == LcpResidual::length ? settings_.lcp.tolerance : 0.0;
    Contacts contacts =
        relinearised_contacts(problem.contacts(), box_, end, max_overlap_of_turning * mean_diameter_ + tolerance);
    const auto velocity = [&](std::uint32_t row) { return solution.velocities[end.local_index[row]]; };
    for (Contact& contact : contacts.contact)
        contact.shifted_gap -= settings_.time_step * gap_rate(contact, velocity(contact.i), velocity(contact.j));
    return contacts;
}

// Theory 1: the sum over contacts of (r_j - r_i) F, and over rods of the geometric part of the net torque. With the
// time-step correction: of rods half way through their collisions (theory, eq. 3.7).
void Simulation::measure_stress(StepReport& report) {
    const std::vector<Vec3>& axis = corrects_brownian_motion() ? half_way_axes() : rods_.axis;
    const auto distance = settings_.brownian_correction ? ContactDistance::touching : ContactDistance::at_start;
    std::vector<Vec3> torque(solution_.rods.size());
    parallel_for(torque.size(), [&](std::size_t place) {
        torque[place] = cross(axis[solution_.rods[place]], solution_.forces[place].lever);
    });
    report.collision_virial =
        sum_of_pair_stresses(contacts_, solution_.gamma, rods_, axis, {solution_.rods, torque}, distance);
    if (settings_.collision_moments)
        moments_ = jostle::collision_moments(contacts_, solution_.gamma, rods_, box_, axis, {solution_.rods, torque},
                                             distance);
    if (settings_.stress_conventions) {
        report.centre_of_mass_virial = centre_of_mass_virial(contacts_, solution_.gamma, rods_, axis, distance);
        report.centre_line_virial = centre_line_virial(contacts_, solution_.gamma, rods_, distance);
    }
    report.active_contacts = parallel_sum<std::size_t>(
        solution_.gamma.size(), [&](std::size_t l) { return solution_.gamma[l] > 0.0 ? std::size_t{1} : 0; });
}

// Axes after the known motion and one half of what contact forces (and springs) turn them, of the rods in contact.
const std::vector<Vec3>& Simulation::half_way_axes() {
    half_way_axis_.resize(rods_.size());
    parallel_for(solution_.rods.size(), [&](std::size_t k) {
        const std::uint32_t row = solution_.rods[k];
        const Vec3& axis = rods_.axis[row];
        const Vec3 collision = cross(axis, solution_.velocities[k].turning);
        const Vec3 known = known_.velocity.angular[row] - 0.5 * turned_by_springs(row);
        half_way_axis_[row] = rotated(axis, settings_.time_step * (known + 0.5 * collision));
    });
    return half_way_axis_;
}

// Angular velocity that springs give to a rod.
Vec3 Simulation::turned_by_springs(std::uint32_t row) const {
    return springs_ ? by_springs_.angular[row] : Vec3{};
}

// Theory 1, eq. (1.16): the forces of springs as the step began, with moments half way through what springs and
// contacts do in it (eq. 1.17).
void Simulation::measure_spring_stress(StepReport& report) {
    if (!springs_) return;
    Velocities pushed = by_springs_;
    parallel_for(solution_.rods.size(), [&](std::size_t place) {
        const std::uint32_t row = solution_.rods[place];
        pushed.linear[row] += solution_.velocities[place].centre;
        pushed.angular[row] += cross(rods_.axis[row], solution_.velocities[place].turning);
    });
    std::vector<Vec3> centre(rods_.size()), axis(rods_.size());
    const double half_step = 0.5 * settings_.time_step;
    parallel_for(rods_.size(), [&](std::size_t i) {
        centre[i] = rods_.centre[i] + half_step * pushed.linear[i];
        axis[i] = rotated(rods_.axis[i], half_step * pushed.angular[i]);
    });
    report.spring_virial = sum_of_spring_stresses(springs_->springs(), pulls_, rods_, centre, axis);
}

// Theory 2.4: q^{k+1} = q^k + dt (U_known + U_C), axes by the exponential map.
void Simulation::advance() {
    auto& [centre, axis] = known_.end;
    const double dt = settings_.time_step;
    parallel_for(solution_.rods.size(), [&](std::size_t k) {
        const std::uint32_t row = solution_.rods[k];
        const auto& [linear, turning] = solution_.velocities[k];
        centre[row] = rods_.centre[row] + dt * (known_.velocity.linear[row] + linear);
        axis[row] = rotated(rods_.axis[row], dt * (known_.velocity.angular[row] + cross(rods_.axis[row], turning)));
    });
    rods_.centre.swap(centre);
    rods_.axis.swap(axis);
    parallel_for(rods_.size(), [&](std::size_t i) { box_.wrap(rods_.centre[i], rods_.image[i]); });
    for (const auto& cause : motions_)
        turn_round(cause->turned_round(rods_, {settings_.seed, clock_.step, settings_.time_step}));
    ++clock_.step;
    clock_.time = static_cast<double>(clock_.step) * settings_.time_step;
}

// Theory 2.6: head and tail change names, and no point of a body moves, nor one that a spring holds.
void Simulation::turn_round(std::span<const std::uint32_t> rows) {
    std::vector<std::uint64_t> ids(rows.size());
    parallel_for(rows.size(), [&](std::size_t k) {
        rods_.axis[rows[k]] = -rods_.axis[rows[k]];
        ids[k] = rods_.id[rows[k]];
    });
    if (springs_) springs_->turn_round(ids);
}

// Theory 5: between two steps cells may divide or die.
void Simulation::divide() {
    lineage_.clear();
    if (!growth_->is_due(clock_.step)) return;
    ids_before_ = rods_.id;
    lineage_ = growth_->divide(rods_, box_, clock_.step, settings_.time_step);
    if (!lineage_.empty()) take_over_rods();
}

}  // namespace jostle
