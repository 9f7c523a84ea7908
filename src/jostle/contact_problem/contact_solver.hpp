#pragma once

#include <functional>
#include <vector>

#include "jostle/contact_problem/delassus_operator.hpp"
#include "jostle/contact_problem/solver_method.hpp"
#include "jostle/lcp/lcp_problem.hpp"

namespace jostle {

/// Contact forces, and what they do to the rods that have contacts (places of the ContactMatrix).
struct ContactSolution {
    std::vector<double> gamma;                ///< (contacts) >= 0
    std::vector<std::uint32_t> rods;          ///< (places) rows
    std::vector<ContactForce> forces;         ///< (places) D gamma
    std::vector<ContactVelocity> velocities;  ///< (places) M D gamma

    /// As many places and contacts as the matrix has; new ones are 0.
    void resize(const ContactMatrix& contact_matrix);
};

/// The contact problem of a step. It may grow while it is solved: contacts that only forces bring about are not known
/// before.
struct ContactProblem {
    const DelassusOperator& matrix;
    const std::vector<double>& constant;  ///< (contacts) b
    double time_step;
    /// Given forces and velocities, appends contacts that were missed (to matrix and b), and says whether there were
    /// any. `final`: the search must be thorough, the result will stand. May be empty.
    std::function<bool(const ContactSolution& solution, bool final)> add_missed;
    std::vector<double> start = {};  ///< (contacts) gamma to begin from; empty: from 0

    LcpProblem lcp() const { return {matrix, constant, time_step}; }
};

/// How a solver ended.
struct SolverOutcome {
    LcpStatus status = LcpStatus::converged;
    double residual = 0.0;
    std::uint64_t iterations = 0;
    std::uint64_t solves = 0;  ///< 1, and one for every time that contacts were added to a solution
};

/// Solves a contact problem by the method asked for; "auto" is projected SOR where the mobility does not couple rods,
/// else adaptive Barzilai-Borwein descent.
///
/// Every method stops at the same residual, verified over all contacts, so results agree to the tolerance. Throws
/// InputError if projected SOR is asked for with a mobility that couples rods.
SolverOutcome solve_contact_problem(const ContactProblem& problem, SolverMethod method, const LcpSettings& settings,
                                    ContactSolution& solution);

}  // namespace jostle
