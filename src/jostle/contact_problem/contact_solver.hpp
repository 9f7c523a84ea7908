#pragma once

#include <memory>

#include "jostle/contact_problem/contact_problem.hpp"
#include "jostle/contact_problem/contact_solution.hpp"
#include "jostle/contact_problem/solver_method.hpp"

namespace jostle {

/// Seeks the forces of a contact problem. It stops where the problem may grow: contacts that only forces bring about
/// are not known before.
///
///     const auto solver = make_contact_solver(problem, method, settings);
///     while (solver->run_to_next_stop()) problem.append(violated pairs ...);
///     if (solver->outcome().status == LcpStatus::converged) use(solver->solution());
///
/// Every method stops at the same residual, verified over all contacts, so results agree to the tolerance.
class ContactSolver {
public:
    virtual ~ContactSolver() = default;

    /// Goes on to the next stop, with all contacts that the problem has now. Returns whether there is one: after
    /// `at_solution`, only if the problem has grown.
    virtual bool run_to_next_stop() = 0;

    /// To be told where the problem has been posed again, with other constants: the next run begins from no forces, and
    /// ends at this tolerance.
    virtual void begin_again(double tolerance) {
        settings_.tolerance = tolerance;
        solution_.gamma.assign(problem_.size(), 0.0);
        solution_.resize(problem_.contact_matrix());
        at_solution_ = at_near_candidate_ = false;
    }

    /// Whether this stop is at a solution, which stands unless the problem grows. If not, only the velocities of the
    /// candidate are up to date, as far as a search for violated pairs needs them.
    bool at_solution() const { return at_solution_; }

    /// Whether this stop is at a solution, or at a candidate whose forces hardly change any more.
    bool near_solution() const { return at_solution_ || at_near_candidate_; }

    const ContactSolution& solution() const { return solution_; }
    const SolverOutcome& outcome() const { return outcome_; }

    /// The solution, once the solver has ended.
    ContactSolution take_solution() && { return std::move(solution_); }

protected:
    ContactSolver(const ContactProblem& problem, const LcpSettings& settings) : problem_(problem), settings_(settings) {
        solution_.gamma = problem.start();
        solution_.resize(problem.contact_matrix());
    }

    /// Whether contacts have been added to the problem since the last call, here or on another rank: the solution is
    /// then as large again.
    bool problem_has_grown() {
        if (!problem_.domain().ranks().any(solution_.gamma.size() != problem_.size())) return false;
        solution_.resize(problem_.contact_matrix());
        return true;
    }

    const ContactProblem& problem_;
    LcpSettings settings_;
    ContactSolution solution_;
    SolverOutcome outcome_;
    bool at_solution_ = false, at_near_candidate_ = false;
};

/// The solver of a method; "auto" is projected SOR where neither the mobility nor the volume couples rods;
/// NearFirst where the mobility couples them and has a near part; else adaptive Barzilai-Borwein descent. Holds a
/// reference to the problem.
///
/// Throws InputError if projected SOR is asked for where they do.
std::unique_ptr<ContactSolver> make_contact_solver(const ContactProblem& problem, SolverMethod method,
                                                   const LcpSettings& settings);

}  // namespace jostle
