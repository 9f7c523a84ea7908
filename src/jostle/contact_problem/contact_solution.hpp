#pragma once

#include <cstdint>
#include <vector>

#include "jostle/contact/contact_matrix.hpp"
#include "jostle/lcp/lcp_problem.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

/// Contact forces, and what they do to the rods that have contacts (numbered by the ContactMatrix).
struct ContactSolution {
    std::vector<double> gamma;                ///< (contacts) >= 0
    std::vector<std::uint32_t> rods;          ///< (n) rows
    std::vector<ContactForce> forces;         ///< (n) D gamma
    std::vector<ContactVelocity> velocities;  ///< (n) M D gamma
    double box_rate = 0.0;                    ///< at which forces open the box (BoxColumn)

    /// As many rods and contacts as the matrix has; new ones are 0.
    void resize(const ContactMatrix& contact_matrix) {
        gamma.resize(contact_matrix.size(), 0.0);
        rods.assign(contact_matrix.rods().begin(), contact_matrix.rods().end());
        forces.resize(rods.size());
        velocities.resize(rods.size());
    }

    /// Forces that act beside these, on the same rods and contacts, of which the other may know less.
    void add(const ContactSolution& other) {
        parallel_for(other.gamma.size(), [&](std::size_t l) { gamma[l] += other.gamma[l]; });
        parallel_for(other.forces.size(), [&](std::size_t local) {
            forces[local].force += other.forces[local].force;
            forces[local].moment += other.forces[local].moment;
            velocities[local].centre += other.velocities[local].centre;
            velocities[local].axis_rate += other.velocities[local].axis_rate;
        });
        box_rate += other.box_rate;
    }
};

/// How a solver ended.
struct SolverOutcome {
    LcpStatus status = LcpStatus::converged;
    double residual = 0.0;
    std::uint64_t iterations = 0;
    std::uint64_t solves = 0;  ///< 1, and one for every time that contacts were added to a solution
};

}  // namespace jostle
