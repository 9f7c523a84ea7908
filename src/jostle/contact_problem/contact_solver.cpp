#include "jostle/contact_problem/contact_solver.hpp"

#include "jostle/contact_problem/projected_sor.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/lcp/adaptive_bb.hpp"
#include "jostle/lcp/apgd.hpp"
#include "jostle/lcp/bbpgd.hpp"
#include "jostle/lcp/minimum_map_newton.hpp"

namespace jostle {

namespace {

LcpResult solve_lcp(const LcpProblem& problem, SolverMethod method, const LcpSettings& settings,
                    std::span<const double> start) {
    switch (method) {
        case SolverMethod::bbpgd:
            return solve_bbpgd(problem, settings, start);
        case SolverMethod::apgd:
            return solve_apgd(problem, settings, start);
        case SolverMethod::minimum_map_newton:
            return solve_minimum_map_newton(problem, settings, start);
        default:
            return solve_adaptive_bb(problem, settings, start);
    }
}

}  // namespace

void ContactSolution::resize(const ContactMatrix& contact_matrix) {
    gamma.resize(contact_matrix.size(), 0.0);
    rods.assign(contact_matrix.rods().begin(), contact_matrix.rods().end());
    forces.resize(rods.size());
    velocities.resize(rods.size());
}

SolverOutcome solve_contact_problem(const ContactProblem& problem, SolverMethod method, const LcpSettings& settings,
                                    ContactSolution& solution) {
    const DelassusOperator& matrix = problem.matrix;
    solution = {};
    solution.gamma = problem.start;
    if (method == SolverMethod::automatic)
        method = matrix.couples_rods() ? SolverMethod::adaptive_bb : SolverMethod::projected_sor;
    if (method == SolverMethod::projected_sor) {
        if (matrix.couples_rods())
            throw InputError({.key = "solver.method",
                              .value = "\"projected_sor\"",
                              .problem = "this method needs a mobility that does not couple rods",
                              .allowed = "\"auto\", \"adaptive_bb\", \"bbpgd\", \"apgd\", \"minimum_map_newton\""});
        return solve_projected_sor(problem, settings, solution);
    }
    SolverOutcome outcome;
    do {
        solution.resize(matrix.contact_matrix());
        const bool from_zero = outcome.solves == 0 && problem.start.empty();
        LcpResult result =
            solve_lcp(problem.lcp(), method, settings, from_zero ? std::span<const double>{} : solution.gamma);
        solution.gamma = std::move(result.solution);
        matrix.velocities(solution.gamma, solution.forces, solution.velocities);
        outcome = {result.status, result.residual, outcome.iterations + result.iterations, outcome.solves + 1};
    } while (outcome.status == LcpStatus::converged && problem.add_missed && problem.add_missed(solution, true));
    return outcome;
}

}  // namespace jostle
