#include "jostle/simulation/forces_at_touching.hpp"

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

ContactSolution forces_at_touching(const ContactProblem& problem, const ContactSolution& solution, const Rods& rods,
                                   const MobilityOperator& mobility) {
    ContactSolution touching = solution;
    parallel_for(problem.size(), [&](std::size_t l) {
        if (solution.gamma[l] == 0.0) return;
        const Contact& contact = problem.contacts().contact[l];
        if (contact.i == contact.j || is_fixed(contact.i)) return;
        PairOfPoints points = points_of(contact, rods);
        const double at_start = mobility.relative_mobility(points);
        points.distance = contact_radii(contact, rods);
        touching.gamma[l] *= at_start / mobility.relative_mobility(points);
    });
    problem.contact_matrix().apply(touching.gamma, touching.forces);
    return touching;
}

}  // namespace jostle
