#include "jostle/setup/remove_overlaps.hpp"

#include <algorithm>

#include "jostle/contact/find_contacts.hpp"
#include "jostle/contact_problem/contact_solver.hpp"
#include "jostle/math/rotation.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

// All lengths in diameters of the thinnest rod.
constexpr double opened_each_round = 0.1;
constexpr double free_space = 1e-3;
constexpr double search_range = 0.1;
constexpr double largest_move = 0.2;  ///< of any point of a rod in a round
constexpr double overlap_tolerance = 1e-4;
constexpr int max_rounds = 2000;
constexpr double overlap_rounding =
    1e-12;  ///< overlaps that are none: of a rod with its own image in a box of just its width
constexpr std::uint64_t iterations_each_round = 300;

/// Moves the rods by the velocities (time step 1), all slowed down alike so that none goes too far.
void move(Rods& rods, const Box& box, const ContactSolution& solution, double limit) {
    const double fastest = parallel_max(solution.rods.size(), 0.0, [&](std::size_t local) {
        const auto& [linear, axis_rate] = solution.velocities[local];
        return norm(linear) + 0.5 * rods.length[solution.rods[local]] * norm(axis_rate);
    });
    const double fraction = fastest > limit ? limit / fastest : 1.0;
    parallel_for(solution.rods.size(), [&](std::size_t local) {
        const std::uint32_t row = solution.rods[local];
        const auto& [linear, axis_rate] = solution.velocities[local];
        rods.centre[row] += fraction * linear;
        box.wrap(rods.centre[row], rods.image[row]);
        rods.axis[row] = rotated(rods.axis[row], fraction * cross(rods.axis[row], axis_rate));
    });
}

}  // namespace

DragLaw overlap_removal_drag(bool turning) {
    return [turning](double length, double diameter) {
        return RodMobility{1.0, 1.0, turning ? 12.0 / (length * length + diameter * diameter) : 0.0};
    };
}

OverlapRemovalResult remove_overlaps(Rods& rods, const Box& box, const Mobility& mobility) {
    OverlapRemovalResult result;
    const double thinnest = rods.size() == 0 ? 1.0 : *std::min_element(rods.diameter.begin(), rods.diameter.end());
    NeighbourList neighbours(0.5 * thinnest);
    const std::vector<double> ranges(rods.size(), search_range * thinnest);
    Contacts contacts;
    for (;; ++result.rounds) {
        neighbours.update(rods, box, ranges);
        result.overlap = find_contacts(rods, box, neighbours, ranges, contacts);
        result.apart = result.overlap <= overlap_rounding * thinnest;
        if (result.apart || result.rounds == max_rounds) return result;

        std::vector<double> b(contacts.size());
        parallel_for(b.size(), [&](std::size_t l) {
            b[l] = std::max(contacts.contact[l].gap - free_space * thinnest, -opened_each_round * thinnest);
        });
        const auto mobility_now = mobility.at(rods, box);
        ContactProblem problem(rods, *mobility_now, contacts, std::move(b), 1.0);
        LcpSettings settings;
        settings.tolerance = overlap_tolerance * thinnest;
        settings.max_iterations = iterations_each_round;
        // A rough solution still leads apart; only the last rounds need to be, and are, solved to the tolerance.
        const auto solver = make_contact_solver(problem, SolverMethod::automatic, settings);
        while (solver->run_to_next_stop()) continue;
        if (solver->outcome().status == LcpStatus::not_finite) return result;
        move(rods, box, solver->solution(), largest_move * thinnest);
    }
}

}  // namespace jostle
