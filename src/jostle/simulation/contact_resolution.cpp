#include "jostle/simulation/contact_resolution.hpp"

#include <algorithm>
#include <utility>

#include "jostle/contact/gaps_at.hpp"
#include "jostle/contact/reflection.hpp"
#include "jostle/contact/relinearised_contacts.hpp"
#include "jostle/contact/wall_contacts.hpp"
#include "jostle/contact/wca_forces.hpp"
#include "jostle/contact_problem/previous_forces.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/simulation/reflected_forces.hpp"

namespace jostle {

namespace {

/// How the problem of one step is linearised about its solution: pairs in contact that would overlap by more there (in
/// D) are taken in as they lie there; so often, and no more.
struct Relinearisation {
    double max_overlap;
    int max_times;
};
constexpr Relinearisation where_forces_turn_rods{0.01, 12}, where_noise_does{0.03, 2};

/// The first of the two solutions of a step only says where paths are mirrored: it is solved to so many tolerances, but
/// no coarser than to this part of how far the known motion takes rods in the mean (decision 0080).
constexpr double mirror_tolerances = 30.0, mirror_part = 0.005;

}  // namespace

ContactProblem ContactResolution::posed(const MobilityOperator& mobility, Contacts found,
                                        const BoxColumn& opening) const {
    std::vector<double> b, start;
    if (!settings_.rods_are_soft()) b = gap_velocities(found);
    if (settings_.warm_start) {
        start = starting_forces(found, state_.rods.id, state_.previous_forces);
        if (domain_.ranks().any(!start.empty())) start.resize(found.size(), 0.0);  // as another rank begins
    }
    const double compliance = settings_.corrects_brownian_motion() ? contact_compliance : 0.0;
    return ContactProblem(state_.rods, mobility, std::move(found), std::move(b), settings_.time_step, compliance,
                          std::move(start), domain_, opening, geometry_.arm_axes());
}

std::optional<ContactSolution> ContactResolution::solve(ContactProblem& problem, StepReport& report) {
    if (settings_.rods_are_soft()) return repelled(problem);
    LcpSettings first = settings_.lcp;
    if (settings_.corrects_brownian_motion()) first.tolerance = tolerance_of_mirrors();
    const auto solver = make_contact_solver(problem, settings_.method, first);
    if (!run_to_solution(*solver, problem, nullptr)) return std::nullopt;
    ContactSolution mirrored;
    if (solver->outcome().status == LcpStatus::converged && settings_.corrects_brownian_motion()) {
        mirrored = reflected(problem, solver->solution());
        problem.pose_again(gap_velocities_beside(mirrored, problem.contacts(), problem));
        solver->begin_again(settings_.lcp.tolerance);
        if (!run_to_solution(*solver, problem, &mirrored)) return std::nullopt;
    }
    const SolverOutcome& outcome = solver->outcome();
    report.status = outcome.status;
    report.residual = outcome.residual;
    report.iterations = outcome.iterations;
    report.solves = outcome.solves;
    ContactSolution solution = std::move(*solver).take_solution();
    solution.add(mirrored);
    return solution;
}

double ContactResolution::tolerance_of_mirrors() const {
    const double tolerance = settings_.lcp.tolerance;
    if (settings_.lcp.residual != LcpResidual::length) return tolerance;
    return std::max(tolerance, std::min(mirror_tolerances * tolerance, mirror_part * geometry_.mean_displacement));
}

// Not in the paper: soft rods. The forces follow from where rods are before the step, and nothing has to be solved.
ContactSolution ContactResolution::repelled(const ContactProblem& problem) const {
    ContactSolution solution;
    solution.gamma = wca_forces(problem.contacts(), state_.rods, settings_.wca_energy);
    problem.complete(solution);
    return solution;
}

ContactSolution ContactResolution::reflected(const ContactProblem& problem, const ContactSolution& solution) const {
    const double strain = settings_.flow ? settings_.flow->strain_of_step(state_.clock, settings_.time_step) : 0.0;
    ContactSolution mirrored;
    mirrored.gamma = reflected_forces(problem, solution, state_, geometry_.arm_axes(), known_, sizes_.own_mobility,
                                      settings_, strain);
    problem.complete(mirrored);
    return mirrored;
}

// The contact problem, with more contacts where forces turn out to bring rods together. `acting`: forces that act
// beside those sought, if any. Whether all rods were known that might be among the contacts.
bool ContactResolution::run_to_solution(ContactSolver& solver, ContactProblem& problem, const ContactSolution* acting) {
    const bool is_last = acting || !settings_.corrects_brownian_motion();
    const Relinearisation how = settings_.relinearise ? where_forces_turn_rods : where_noise_does;
    int relinearisations = is_last && (settings_.relinearise || acting) ? how.max_times : 0;
    EndConfiguration end = after_known_motion();
    while (solver.run_to_next_stop()) {
        const ContactSolution& solution = solver.solution();
        end.set_velocities(problem.rods_with_contacts(),
                           {acting ? acting->velocities : std::span<const ContactVelocity>{}, solution.velocities});
        end.find_displacements();
        Contacts more;
        if (solver.near_solution() && relinearisations-- > 0) {
            end.place_rods();
            const Box box = opened_by((acting ? acting->box_rate : 0.0) + solution.box_rate);
            more = relinearised(problem, box, end, solution, how.max_overlap);
        }
        const auto met = violated(problem, end);
        if (!met) return false;
        more.append(*met);
        if (more.size() == 0) continue;
        const auto b = acting ? gap_velocities_beside(*acting, more, problem) : gap_velocities(more);
        problem.append(more, b);
    }
    return true;
}

// The box at the end of the step, where contact forces open it at this rate.
Box ContactResolution::opened_by(double rate) const {
    if (!opens_in_step(settings_.pressure, settings_.kT)) return state_.box;
    return state_.box.with_edges(opened(state_.box.edges(), *settings_.pressure, rate, settings_.time_step));
}

// Pairs that are no contacts and yet touch at the end of the step, as contacts: also rods that a piston which goes
// before them will not have touched. None if rods of other ranks might be
// among them that are not known.
std::optional<Contacts> ContactResolution::violated(const ContactProblem& problem, const EndConfiguration& end) {
    const auto pairs = searches_.rods.violated_pairs(geometry_, problem.contacts(), end);
    if (domain_.ranks().any(searches_.rods.lacks_pairs())) return std::nullopt;
    Contacts contacts = searches_.rods.activate(pairs, geometry_);
    contacts.append(searches_.walls.violated(geometry_, end));
    contacts.append(searches_.fixed_rods.violated(geometry_, end));
    return contacts;
}

// Not in the paper (theory, eq. 2.18): the problem again, linear about where its solution takes those rods that would
// overlap there.
Contacts ContactResolution::relinearised(const ContactProblem& problem, const Box& box, const EndConfiguration& end,
                                         const ContactSolution& solution, double max_overlap_per_diameter) const {
    const Contacts& contacts = problem.contacts();
    // Beyond what the solver may leave.
    const double tolerance = settings_.lcp.residual == LcpResidual::length ? settings_.lcp.tolerance : 0.0;
    const double max_overlap = max_overlap_per_diameter * sizes_.mean_diameter + tolerance;
    Contacts more = relinearised_contacts(contacts, box, end, max_overlap);
    more.append(relinearised_wall_contacts(contacts, box, end, max_overlap));
    more.append(relinearised_fixed_rod_contacts(contacts, box, end, max_overlap));
    const auto velocity = [&](std::uint32_t body) {
        return is_fixed(body) ? ContactVelocity{} : solution.velocities[problem.contact_matrix().local_index()[body]];
    };
    for (Contact& contact : more.contact) {
        const double by_rods = gap_rate(contact, velocity(contact.i), velocity(contact.j));
        const double by_box = solution.box_rate * problem.matrix().column_of(contact);
        contact.gap_after -= settings_.time_step * (by_rods + by_box);
    }
    return more;
}

// b of the contact problem (theory, eq. 3.3): the gap after the known motion over dt; or as in the paper,
// b = Phi/dt + D^T U_known.
std::vector<double> ContactResolution::gap_velocities(const Contacts& contacts) const {
    const double dt = settings_.time_step;
    std::vector<double> b(contacts.size());
    parallel_for(b.size(), [&](std::size_t l) {
        const Contact& contact = contacts.contact[l];
        const bool found_later = contacts.feature[l] == ContactFeature::relinearised || contact.i == contact.j;
        b[l] = settings_.brownian_correction || found_later
                   ? contact.gap_after / dt
                   : contact.gap / dt + gap_rate(contact, geometry_.arm_axes(), known_.velocity);
    });
    return b;
}

// b where other forces act already: the gap to which they take the rods, over dt.
std::vector<double> ContactResolution::gap_velocities_beside(const ContactSolution& acting, const Contacts& contacts,
                                                             const ContactProblem& problem) const {
    EndConfiguration there = after_known_motion();
    there.set_velocities(problem.rods_with_contacts(), {acting.velocities});
    if (contacts.size() > there.rows().size() / 2) there.place_rods();
    std::vector<double> b = gaps_at(contacts, opened_by(acting.box_rate), there);
    parallel_for(b.size(), [&](std::size_t l) {
        if (contacts.feature[l] == ContactFeature::relinearised) b[l] = contacts.contact[l].gap_after;
        b[l] /= settings_.time_step;
    });
    return b;
}

}  // namespace jostle
