#include "jostle/simulation/contact_solver.hpp"

#include "jostle/error/input_error.hpp"
#include "jostle/lcp/bbpgd.hpp"
#include "jostle/simulation/projected_sor.hpp"

namespace jostle {

LcpResult solve_contact_problem(const ContactMatrix& contact_matrix, const Mobility& mobility,
                                const DelassusOperator& matrix, const LcpProblem& problem, SolverMethod method,
                                const LcpSettings& settings, std::span<const double> start) {
    if (method == SolverMethod::automatic)
        method = mobility.couples_rods() ? SolverMethod::bbpgd : SolverMethod::projected_sor;
    if (method == SolverMethod::bbpgd) return solve_bbpgd(problem, settings, start);
    if (mobility.couples_rods())
        throw InputError({.key = "solver.method",
                          .value = "\"projected_sor\"",
                          .problem = "this method needs a mobility that does not couple rods",
                          .allowed = "\"auto\", \"bbpgd\""});
    return solve_projected_sor(contact_matrix, mobility, matrix, problem, settings, start);
}

}  // namespace jostle
