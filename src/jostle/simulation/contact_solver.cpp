#include "jostle/simulation/contact_solver.hpp"

#include "jostle/error/input_error.hpp"
#include "jostle/lcp/adaptive_bb.hpp"
#include "jostle/lcp/apgd.hpp"
#include "jostle/lcp/bbpgd.hpp"
#include "jostle/lcp/minimum_map_newton.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/simulation/projected_sor.hpp"

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

/// Contacts that give way, as a linear problem of twice the size. Each rests on two springs side by side, one soft and
/// one, which begins to push at the knee, so stiff that the two together are what is asked for:
///
///     [A + soft   A       ] [force of the soft one ]   [b       ]
///     [A          A + rest] [force of the stiff one] + [b + give]
class TwoSprings final : public LinearOperator {
public:
    TwoSprings(const DelassusOperator& matrix, std::span<const double> b)
        : matrix_(matrix), contacts_(matrix.size()), constant_(2 * contacts_), diagonal_(2 * contacts_) {
        rest_.resize(contacts_);
        both_.resize(contacts_);
        rates_.resize(contacts_);
        parallel_for(contacts_, [&](std::size_t l) {
            const GivingWay::Contact way = matrix.giving_way(l);
            const double softer = way.soft > way.stiff ? way.soft / (way.soft - way.stiff) : 0.0;  // 0 where A_ll is
            rest_[l] = softer * way.stiff;
            diagonal_[l] = matrix.diagonal()[l] + way.soft;
            diagonal_[contacts_ + l] = matrix.diagonal()[l] + rest_[l];
            constant_[l] = b[l];
            constant_[contacts_ + l] = b[l] + softer * way.knee;
        });
    }

    std::size_t size() const override { return 2 * contacts_; }
    std::span<const double> diagonal() const override { return diagonal_; }
    std::span<const double> constant() const { return constant_; }

    void apply(std::span<const double> x, std::span<double> result) const override {
        const auto soft = x.first(contacts_), stiff = x.last(contacts_);
        parallel_for(contacts_, [&](std::size_t l) { both_[l] = soft[l] + stiff[l]; });
        matrix_.apply(both_, rates_);
        parallel_for(contacts_, [&](std::size_t l) {
            result[l] = rates_[l] + matrix_.giving_way(l).soft * soft[l];
            result[contacts_ + l] = rates_[l] + rest_[l] * stiff[l];
        });
    }

    /// The forces of the springs, of those of the contacts; and back.
    std::vector<double> split(std::span<const double> gamma) const {
        std::vector<double> forces(2 * contacts_);
        parallel_for(contacts_, [&](std::size_t l) {
            const GivingWay::Contact way = matrix_.giving_way(l);
            forces[l] = way.soft > 0.0 ? way.by(gamma[l]) / way.soft : gamma[l];
            forces[contacts_ + l] = gamma[l] - forces[l];
        });
        return forces;
    }
    std::vector<double> join(std::span<const double> forces) const {
        std::vector<double> gamma(contacts_);
        parallel_for(contacts_, [&](std::size_t l) { gamma[l] = forces[l] + forces[contacts_ + l]; });
        return gamma;
    }

private:
    const DelassusOperator& matrix_;
    std::size_t contacts_;
    std::vector<double> constant_, diagonal_, rest_;
    mutable std::vector<double> both_, rates_;  ///< scratch
};

/// By descent, from `start` (empty: from 0).
LcpResult solve_by_descent(const ContactProblem& problem, SolverMethod method, const LcpSettings& settings,
                           std::span<const double> start) {
    if (!problem.matrix.gives_way()) return solve_lcp(problem.lcp(), method, settings, start);
    const TwoSprings springs(problem.matrix, problem.constant);
    const std::vector<double> split = start.empty() ? std::vector<double>{} : springs.split(start);
    LcpResult result = solve_lcp({springs, springs.constant(), problem.time_step}, method, settings, split);
    result.solution = springs.join(result.solution);
    return result;
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
            solve_by_descent(problem, method, settings, from_zero ? std::span<const double>{} : solution.gamma);
        solution.gamma = std::move(result.solution);
        matrix.velocities(solution.gamma, solution.forces, solution.velocities);
        outcome = {result.status, result.residual, outcome.iterations + result.iterations, outcome.solves + 1};
    } while (outcome.status == LcpStatus::converged && problem.add_missed && problem.add_missed(solution, true));
    return outcome;
}

}  // namespace jostle
