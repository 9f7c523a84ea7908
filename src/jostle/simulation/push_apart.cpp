#include "jostle/simulation/push_apart.hpp"

#include <algorithm>

#include "jostle/contact/find_contacts.hpp"
#include "jostle/math/rotation.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/simulation/contact_solver.hpp"

namespace jostle {

namespace {

// All lengths in diameters of the thinnest rod.
constexpr double opened_each_round = 0.1;
constexpr double free_space = 1e-3;
constexpr double reach = 0.1;
constexpr double largest_move = 0.2;  ///< of any point of a rod in a round
constexpr double tolerance = 1e-4;
constexpr std::uint64_t iterations_each_round = 300;

/// Moves the rods by the velocities (time step 1), all slowed down alike so that none goes too far.
void move(Rods& rods, const Box& box, const Velocities& velocities, double limit) {
    const double fastest = parallel_max(rods.size(), 0.0, [&](std::size_t i) {
        return norm(velocities.linear[i]) + 0.5 * rods.length[i] * norm(velocities.angular[i]);
    });
    const double fraction = fastest > limit ? limit / fastest : 1.0;
    parallel_for(rods.size(), [&](std::size_t i) {
        rods.centre[i] += fraction * velocities.linear[i];
        box.wrap(rods.centre[i], rods.image[i]);
        rods.axis[i] = rotated(rods.axis[i], fraction * velocities.angular[i]);
    });
}

}  // namespace

PushApartResult push_apart(Rods& rods, const Box& box, Mobility& mobility, int largest_rounds) {
    PushApartResult result;
    mobility.update(rods);
    const double thinnest = rods.size() == 0 ? 1.0 : *std::min_element(rods.diameter.begin(), rods.diameter.end());
    NeighbourList neighbours(0.5 * thinnest);
    const std::vector<double> reaches(rods.size(), reach * thinnest);
    Contacts contacts;
    Forces forces(rods.size());
    Velocities velocities(rods.size());
    for (;; ++result.rounds) {
        neighbours.update(rods, box, reaches);
        result.overlap = find_contacts(rods, box, neighbours, reaches, contacts);
        result.apart = result.overlap <= 0.0;
        if (result.apart || result.rounds == largest_rounds) return result;

        std::vector<double> b(contacts.size());
        parallel_for(b.size(), [&](std::size_t l) {
            b[l] = std::max(contacts.contact[l].gap - free_space * thinnest, -opened_each_round * thinnest);
        });
        const ContactMatrix contact_matrix(contacts, rods);
        const DelassusOperator matrix(contact_matrix, mobility);
        LcpSettings settings;
        settings.tolerance = tolerance * thinnest;
        settings.max_iterations = iterations_each_round;
        // A rough solution still leads apart; only the last rounds need to be, and are, solved to the tolerance.
        const LcpResult solved = solve_contact_problem(contact_matrix, mobility, matrix, {matrix, b, 1.0},
                                                       SolverMethod::automatic, settings);
        if (solved.status == LcpStatus::not_finite) return result;
        matrix.velocities(solved.solution, forces, velocities);
        move(rods, box, velocities, largest_move * thinnest);
    }
}

}  // namespace jostle
