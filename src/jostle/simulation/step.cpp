// One step of the simulation, in the order of docs/theory: read `step`, then the functions that it calls.

#include <chrono>
#include <optional>
#include <tuple>

#include "jostle/contact/pushed_overlaps.hpp"
#include "jostle/contact/wca_forces.hpp"
#include "jostle/contact_problem/delassus_operator.hpp"
#include "jostle/contact_problem/time_step_correction.hpp"
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
constexpr double most_pushed_overlap = 0.01;
/// So often, and no more, are their overlaps looked for in one step.
constexpr int most_looks = 5;

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
    find_known_velocity();
    timer.finish(StepPhase::known_velocity);
    find_contacts(report);
    timer.finish(StepPhase::find_contacts);
    settings_.wca_energy > 0.0 ? repel(report) : solve_contacts(report);
    timer.finish(StepPhase::solve_contacts);
    if (report.status != LcpStatus::converged) {
        pushes_.assign(rods_.size(), {});
        return report;
    }
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
void Simulation::find_known_velocity() {
    parallel_for(rods_.size(), [&](std::size_t i) { known_.linear[i] = known_.angular[i] = Vec3{}; });
    for (const auto& cause : motions_) cause->add_to(known_, rods_, {settings_.seed, clock_.step, settings_.time_step});
    if (springs_) pull_springs();
    parallel_for(rods_.size(), [&](std::size_t i) {
        moved_.centre[i] = rods_.centre[i] + settings_.time_step * known_.linear[i];
        moved_.axis[i] = rotated(rods_.axis[i], settings_.time_step * known_.angular[i]);
        displacement_[i] = farthest_displacement(moved_.centre[i] - rods_.centre[i], moved_.axis[i] - rods_.axis[i],
                                                 0.5 * rods_.length[i]);
    });
    find_allowances();
}

// Theory 2.7: the springs' part of U_known.
void Simulation::pull_springs() {
    pulls_ = springs_->pulls(rods_);
    by_springs_ = springs_->velocities(rods_, pulls_);
    parallel_for(rods_.size(), [&](std::size_t i) {
        known_.linear[i] += by_springs_.linear[i];
        known_.angular[i] += by_springs_.angular[i];
    });
}

// Theory 2.2: all pairs of points that may touch in this step.
void Simulation::find_contacts(StepReport& report) {
    ids_before_.clear();
    report.max_overlap = search_.find(rods_, box_, motion(), contacts_);
}

// Theory 3: the gap at which two compliant contacts touch, eq. 3.5.
double Simulation::shift_of(const Contact& contact) const {
    const auto rod = [this](std::uint32_t row) {
        return DelassusOperator::Rod{rods_.axis[row], mobility_->of_rod(row)};
    };
    return brownian_shift(settings_.kT, settings_.time_step, gap_mobility(contact, rod(contact.i), rod(contact.j)));
}

// Theory 2.3: 0 <= A gamma + b  perp  gamma >= 0, with more contacts where forces turn out to bring rods together.
void Simulation::solve_contacts(StepReport& report) {
    using Include = ContactMatrix::Include;
    ContactMatrix contact_matrix(contacts_, rods_.id,
                                 mobility_->couples_rods() ? Include::all_rods : Include::rods_with_contacts);
    const double compliance = corrects_brownian_motion() ? contact_compliance : 0.0;
    DelassusOperator matrix(contact_matrix, rods_, *mobility_, compliance);
    std::vector<double> b, start;
    extend_gap_velocities(b);
    if (settings_.warm_start) start = warm_start_.guess(contacts_, rods_.id);
    int looks = settings_.look_again ? most_looks : 0;
    const auto add_missed = [&](const ContactSolution& solution, bool final) {
        // The latter first: a contact that was missed has no force yet, and is not to be mended as one that has.
        const bool pushed = final && looks-- > 0 && add_pushed_contacts(contact_matrix, solution);
        const bool missed = add_missed_contacts(contact_matrix, solution, final);
        if (!pushed && !missed) return false;
        contact_matrix.extend();
        matrix.extend();
        extend_gap_velocities(b);
        return true;
    };
    const SolverOutcome outcome = solve_contact_problem({matrix, b, settings_.time_step, add_missed, std::move(start)},
                                                        settings_.method, settings_.lcp, solution_);
    report.status = outcome.status;
    report.residual = outcome.residual;
    report.iterations = outcome.iterations;
    report.solves = outcome.solves;
    report.contacts = contacts_.size();
}

// Not in the paper: soft rods. The forces follow from the places before the step, and nothing has to be solved.
void Simulation::repel(StepReport& report) {
    const ContactMatrix contact_matrix(contacts_, rods_.id);
    const DelassusOperator matrix(contact_matrix, rods_, *mobility_);
    solution_ = {};
    solution_.resize(contact_matrix);
    solution_.gamma = wca_forces(contacts_, rods_, settings_.wca_energy);
    matrix.velocities(solution_.gamma, solution_.forces, solution_.velocities);
    report.contacts = contacts_.size();
}

// b of the contact problem (theory, eq. 3.3): the gap after the known motion, shifted, over dt; or as in the paper,
// b = Phi/dt + D^T U_known.
void Simulation::extend_gap_velocities(std::vector<double>& b) const {
    const double dt = settings_.time_step;
    const std::size_t known = b.size();
    b.resize(contacts_.size());
    parallel_for(b.size() - known, [&](std::size_t k) {
        const std::size_t l = known + k;
        const Contact& contact = contacts_.contact[l];
        // Points found after a motion have their gap there.
        const bool found_later = contacts_.feature[l] == ContactFeature::pushed || contact.i == contact.j;
        if (settings_.brownian_correction || found_later) {
            b[l] = contact.room / dt;
            return;
        }
        const auto velocity = [&](std::uint32_t row) {
            return ContactVelocity{known_.linear[row], cross(known_.angular[row], rods_.axis[row])};
        };
        b[l] = contact.gap / dt + gap_rate(contact, velocity(contact.i), velocity(contact.j));
    });
}

// Centre and axis of a rod after the step, with the velocity that contact forces give it.
std::pair<Vec3, Vec3> Simulation::pushed(std::uint32_t row, const ContactVelocity& velocity) const {
    const double dt = settings_.time_step;
    const Vec3& axis = rods_.axis[row];
    return {rods_.centre[row] + dt * (known_.linear[row] + velocity.centre),
            rotated(axis, dt * (known_.angular[row] + cross(axis, velocity.turning)))};
}

// Where forces take the rods: those without contacts, where the known motion does.
RodAfter Simulation::places_after(const ContactMatrix& contact_matrix, const ContactSolution& solution) const {
    return [&](std::uint32_t row) -> std::pair<Vec3, Vec3> {
        const std::uint32_t place = contact_matrix.place_of(row);
        if (place == ContactMatrix::no_place) return {moved_.centre[row], moved_.axis[row]};
        return pushed(row, solution.velocities[place]);
    };
}

// Rods may be pushed into others that were no contacts. Says whether there were such, and makes them contacts.
bool Simulation::add_missed_contacts(const ContactMatrix& contact_matrix, const ContactSolution& solution, bool final) {
    const double dt = settings_.time_step;
    const auto rows = contact_matrix.rods();
    parallel_for(rows.size(), [&](std::size_t place) {
        const std::uint32_t row = rows[place];
        const auto& [linear, turning] = solution.velocities[place];
        const double half = 0.5 * rods_.length[row];
        // Rotations add up to second order in their angles.
        const double twist = half * dt * dt * norm(turning) * norm(known_.angular[row]);
        const Vec3 centre = dt * linear, end = (dt * half) * turning;
        const double farthest = farthest_displacement(centre, dt * turning, half) + twist;
        const double rounding = 1e-6 * farthest;
        pushes_[row] = {in_float(centre), in_float(end), static_cast<float>(farthest + rounding),
                        static_cast<float>(twist + rounding)};
    });
    const auto missed = search_.missed_pairs(rods_, box_, motion(), contacts_, rows, pushes_,
                                             places_after(contact_matrix, solution), final);
    search_.add(missed, rods_, box_, motion(), contacts_);
    return !missed.empty();
}

// Not in the paper (theory, eq. 2.18): the problem again, linear about where its solution takes those rods that would
// overlap there.
bool Simulation::add_pushed_contacts(const ContactMatrix& contact_matrix, const ContactSolution& solution) {
    // Beyond what the solver may leave.
    const double tolerance = settings_.lcp.residual == LcpResidual::length ? settings_.lcp.tolerance : 0.0;
    const Contacts pushed = pushed_overlaps(contacts_, rods_, box_, places_after(contact_matrix, solution),
                                            most_pushed_overlap * mean_diameter_ + tolerance);
    const auto velocity = [&](std::uint32_t row) { return solution.velocities[contact_matrix.place_of(row)]; };
    for (std::size_t l = 0; l < pushed.size(); ++l) {
        Contact contact = pushed.contact[l];
        contact.room -= settings_.time_step * gap_rate(contact, velocity(contact.i), velocity(contact.j));
        contacts_.push_back(contact, pushed.image[l], ContactFeature::pushed);
    }
    return pushed.size() > 0;
}

// Theory 1: the sum over contacts of (r_j - r_i) F, and over rods of the geometric part of the net torque. With the
// time-step correction: of rods half way through their collisions (theory, eq. 3.7).
void Simulation::measure_stress(StepReport& report) {
    const std::vector<Vec3>& axis = corrects_brownian_motion() ? turned_half_way() : rods_.axis;
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

// Axes after the known motion and one half of what contact forces (and springs) turn them; of the rods in contact,
// those that matter. `advance` overwrites them.
const std::vector<Vec3>& Simulation::turned_half_way() {
    parallel_for(solution_.rods.size(), [&](std::size_t place) {
        const std::uint32_t row = solution_.rods[place];
        const Vec3& axis = rods_.axis[row];
        const Vec3 collision = cross(axis, solution_.velocities[place].turning);
        const Vec3 known = known_.angular[row] - 0.5 * turned_by_springs(row);
        moved_.axis[row] = rotated(axis, settings_.time_step * (known + 0.5 * collision));
    });
    return moved_.axis;
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
    parallel_for(solution_.rods.size(), [&](std::size_t place) {
        const std::uint32_t row = solution_.rods[place];
        std::tie(moved_.centre[row], moved_.axis[row]) = pushed(row, solution_.velocities[place]);
        pushes_[row] = {};
    });
    rods_.centre.swap(moved_.centre);
    rods_.axis.swap(moved_.axis);
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
