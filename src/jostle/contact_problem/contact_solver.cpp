#include "jostle/contact_problem/contact_solver.hpp"

#include <utility>

#include "jostle/contact_problem/near_first.hpp"
#include "jostle/contact_problem/projected_sor.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/lcp/adaptive_bb.hpp"
#include "jostle/lcp/apgd.hpp"
#include "jostle/lcp/bbpgd.hpp"
#include "jostle/lcp/minimum_map_newton.hpp"

namespace jostle {

namespace {

/// The methods of lcp/, which know nothing of rods: every stop is at a solution, and the next solution begins from it.
class LcpContactSolver final : public ContactSolver {
public:
    LcpContactSolver(const ContactProblem& problem, SolverMethod method, const LcpSettings& settings)
        : ContactSolver(problem, settings), method_(method) {}

    bool run_to_next_stop() override {
        const bool begins = std::exchange(begins_, false);
        if (!problem_has_grown() && !begins) return false;
        const bool from_zero = begins && (problem_.start().empty() || outcome_.solves > 0);
        LcpResult result = solve(from_zero ? std::span<const double>{} : solution_.gamma);
        solution_.gamma = std::move(result.solution);
        problem_.complete(solution_);
        outcome_ = {result.status, result.residual, outcome_.iterations + result.iterations, outcome_.solves + 1};
        at_solution_ = outcome_.status == LcpStatus::converged;
        return at_solution_;
    }

    void begin_again(double tolerance) override {
        ContactSolver::begin_again(tolerance);
        begins_ = true;
    }

private:
    LcpResult solve(std::span<const double> start) const {
        switch (method_) {
            case SolverMethod::bbpgd:
                return solve_bbpgd(problem_.lcp(), settings_, start);
            case SolverMethod::apgd:
                return solve_apgd(problem_.lcp(), settings_, start);
            case SolverMethod::minimum_map_newton:
                return solve_minimum_map_newton(problem_.lcp(), settings_, start);
            default:
                return solve_adaptive_bb(problem_.lcp(), settings_, start);
        }
    }

    SolverMethod method_;
    bool begins_ = true;
};

}  // namespace

std::unique_ptr<ContactSolver> make_contact_solver(const ContactProblem& problem, SolverMethod method,
                                                   const LcpSettings& settings) {
    const bool couples_rods = problem.matrix().couples_rods(), opens_box = problem.matrix().opens_box();
    if (method == SolverMethod::automatic && couples_rods && !opens_box && problem.matrix().mobility().among({}))
        return std::make_unique<NearFirst>(problem, settings);
    const bool couples_all = couples_rods || problem.matrix().box().joins_all();
    if (method == SolverMethod::automatic)
        method = couples_all ? SolverMethod::adaptive_bb : SolverMethod::projected_sor;
    if (method != SolverMethod::projected_sor) return std::make_unique<LcpContactSolver>(problem, method, settings);
    if (couples_all)
        throw InputError(
            {.key = "solver.method",
             .value = "\"projected_sor\"",
             .problem =
                 "this method needs a mobility that does not couple rods, and a box whose volume forces do not change",
             .allowed = "\"auto\", \"adaptive_bb\", \"bbpgd\", \"apgd\", \"minimum_map_newton\""});
    return std::make_unique<ProjectedSor>(problem, settings);
}

}  // namespace jostle
