// One step of the simulation, in the order of docs/theory: read `step`, then the five functions below it.

#include <algorithm>
#include <chrono>

#include "jostle/contact/find_contacts.hpp"
#include "jostle/math/rotation.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/simulation/delassus_operator.hpp"
#include "jostle/simulation/simulation.hpp"
#include "jostle/simulation/time_step_correction.hpp"
#include "jostle/stress/collision_stress.hpp"

namespace jostle {

namespace {

/// Beyond its known motion a rod is given this much (in D) to be pushed by others before contacts are looked for again.
constexpr double push_allowance = 0.02;

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

/// How far any point of rod `i` moves at most in a step with these velocities.
double largest_displacement(const Rods& rods, std::size_t i, const Velocities& velocities, double time_step) {
    return time_step * (norm(velocities.linear[i]) + 0.5 * rods.length[i] * norm(velocities.angular[i]));
}

/// gamma of `old_contacts` carried over to those of `contacts` that are the same; 0 for new ones.
std::vector<double> carried_over(const Contacts& old_contacts, const std::vector<double>& gamma,
                                 const Contacts& contacts) {
    const auto place = [](const Contacts& in, std::size_t l) {
        return std::make_tuple(in.contact[l].i, in.contact[l].j, in.image[l]);
    };
    std::vector<double> carried(contacts.size(), 0.0);
    std::size_t old = 0;
    for (std::size_t l = 0; l < contacts.size(); ++l) {
        while (old < old_contacts.size() && place(old_contacts, old) < place(contacts, l)) ++old;
        for (std::size_t k = old; k < old_contacts.size() && place(old_contacts, k) == place(contacts, l); ++k)
            if (old_contacts.contact[k].arm_i == contacts.contact[l].arm_i &&
                old_contacts.contact[k].arm_j == contacts.contact[l].arm_j)
                carried[l] = gamma[k];
    }
    return carried;
}

}  // namespace

StepReport Simulation::step() {
    StepReport report;
    report.step = clock_.step;
    report.time = clock_.time;
    PhaseTimer timer(report);

    find_known_velocity();
    timer.finish(StepPhase::known_velocity);
    bool seen = false;
    do {
        find_contacts(report);
        timer.finish(StepPhase::find_contacts);
        solve_contacts(report);
        timer.finish(StepPhase::solve_contacts);
        if (report.status != LcpStatus::converged) return report;
        seen = all_collisions_seen();
        timer.finish(StepPhase::find_contacts);
    } while (!seen);
    measure_stress(report);
    timer.finish(StepPhase::measure_stress);
    advance();
    timer.finish(StepPhase::advance);
    return report;
}

// Theory 2.1: U_known, the sum of all motions; and how far it lets each rod come towards others.
void Simulation::find_known_velocity() {
    parallel_for(rods_.size(), [&](std::size_t i) { known_.linear[i] = known_.angular[i] = Vec3{}; });
    for (const auto& motion : motions_)
        motion->add_to(known_, rods_, {settings_.seed, clock_.step, settings_.time_step});
    parallel_for(rods_.size(), [&](std::size_t i) {
        const double moved = largest_displacement(rods_, i, known_, settings_.time_step);
        reach_[i] = std::max(moved + shift_reach_[i] + push_allowance * rods_.diameter[i], 0.5 * settings_.range);
    });
    contacts_.clear();
    solution_.gamma.clear();
}

// Theory 2.2: all pairs of points that may touch in this step. A second call in the same step, with a larger reach,
// keeps gamma.
void Simulation::find_contacts(StepReport& report) {
    neighbours_.update(rods_, box_, reach_);
    const Contacts before = std::move(contacts_);
    contacts_ = Contacts{};
    report.max_overlap = jostle::find_contacts(rods_, box_, neighbours_, reach_, contacts_);
    report.contacts = contacts_.size();
    solution_.gamma = carried_over(before, solution_.gamma, contacts_);
}

// Theory 2.3: 0 <= A gamma + b  perp  gamma >= 0.
void Simulation::solve_contacts(StepReport& report) {
    const ContactMatrix contact_matrix(contacts_, rods_);
    const DelassusOperator matrix(contact_matrix, *mobility_);
    const std::vector<double> constant = gap_velocities_without_forces(matrix.diagonal());
    const bool again = report.solves > 0;
    LcpResult result =
        solve_contact_problem(contact_matrix, *mobility_, matrix, {matrix, constant, settings_.time_step},
                              settings_.method, settings_.lcp, again ? solution_.gamma : std::span<const double>{});
    solution_.gamma = std::move(result.solution);
    matrix.velocities(solution_.gamma, solution_.forces, solution_.velocities);
    report.status = result.status;
    report.residual = result.residual;
    report.iterations += result.iterations;
    ++report.solves;
}

// b of the contact problem (theory, eq. 3.3): the gap after the known motion, shifted, over dt; or as in the paper,
// b = Phi/dt + D^T U_known.
std::vector<double> Simulation::gap_velocities_without_forces(std::span<const double> diagonal) const {
    const double dt = settings_.time_step;
    std::vector<double> b(contacts_.size());
    if (!settings_.brownian_correction) {
        ContactMatrix(contacts_, rods_).apply_transpose(known_, b);
        parallel_for(b.size(), [&](std::size_t l) { b[l] += contacts_.contact[l].gap / dt; });
        return b;
    }
    std::vector<Vec3> centre(rods_.size()), axis(rods_.size());
    parallel_for(rods_.size(), [&](std::size_t i) {
        centre[i] = rods_.centre[i] + dt * known_.linear[i];
        axis[i] = rotated(rods_.axis[i], dt * known_.angular[i]);
    });
    parallel_for(b.size(), [&](std::size_t l) {
        const double shift = brownian_shift(settings_.kT, dt, diagonal[l]);
        b[l] = (gap_at(contacts_, l, rods_, box_, centre, axis) - shift) / dt;
    });
    return b;
}

// Rods may be pushed farther than contacts were looked for. If one then met another unseen, widen the reach and say no.
bool Simulation::all_collisions_seen() {
    Velocities total = known_;
    parallel_for(rods_.size(), [&](std::size_t i) {
        total.linear[i] += solution_.velocities.linear[i];
        total.angular[i] += solution_.velocities.angular[i];
    });
    std::vector<double> needed(rods_.size());
    parallel_for(rods_.size(), [&](std::size_t i) {
        needed[i] = std::max(reach_[i], largest_displacement(rods_, i, total, settings_.time_step) + shift_reach_[i]);
    });
    if (needed == reach_) return true;
    neighbours_.update(rods_, box_, needed);
    const Movement movement{reach_, needed, shift_reach_, total, settings_.time_step};
    const bool unseen = any_unseen_collision(rods_, box_, neighbours_, movement);
    if (unseen) reach_ = std::move(needed);
    return !unseen;
}

// Theory 1: the sum over contacts of (r_j - r_i) F, and over rods of the geometric part of the net torque.
void Simulation::measure_stress(StepReport& report) const {
    const auto distance = settings_.brownian_correction ? ContactDistance::touching : ContactDistance::at_start;
    report.collision_virial =
        sum_of_pair_stresses(contacts_, solution_.gamma, rods_, solution_.forces.torque, distance);
    report.active_contacts = static_cast<std::size_t>(
        std::count_if(solution_.gamma.begin(), solution_.gamma.end(), [](double gamma) { return gamma > 0.0; }));
}

// Theory 2.4: q^{k+1} = q^k + dt (U_known + U_C), axes by the exponential map.
void Simulation::advance() {
    const double dt = settings_.time_step;
    parallel_for(rods_.size(), [&](std::size_t i) {
        rods_.centre[i] += dt * (known_.linear[i] + solution_.velocities.linear[i]);
        box_.wrap(rods_.centre[i], rods_.image[i]);
        rods_.axis[i] = rotated(rods_.axis[i], dt * (known_.angular[i] + solution_.velocities.angular[i]));
    });
    ++clock_.step;
    clock_.time = static_cast<double>(clock_.step) * dt;
}

}  // namespace jostle
