#include "jostle/contact_problem/projected_sor.hpp"

#include <cmath>

#include "jostle/contact_problem/sweeper.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

/// Over-relaxation: measured best between 1.3 and 1.4 for hard contacts of dilute and isotropic rods, between 1.0
/// and 1.1 for compliant ones, whose matrix is better conditioned; harder problems want more, and so do those that
/// begin warm, with what is left to the slowest modes of a crowd.
double relaxation(std::uint64_t sweep, bool compliant, bool warm) {
    return sweep >= 60 || warm ? 1.6 : compliant ? 1.1 : 1.35;
}

/// Every so many sweeps, and after a verification, one passes over all contacts. Beginning warm, most of them rest, and
/// have less need of being looked at.
constexpr std::uint64_t full_sweep_every = 5, full_sweep_every_if_warm = 10;
/// Sweeps in float are right to about 1e-6 of the deepest overlap, and finer tolerances are left to double.
constexpr double finest_in_float = 1e-5;
/// Double takes over where so many verifications have found more residual than the sweeps in float had left to do.
constexpr int patience_with_float = 3;
/// After this sweep, and three times as many, and so on, missed contacts are looked for before the sweeps have settled.
constexpr std::uint64_t early_search = 6;
/// Every so many sweeps it is asked whether to go on.
constexpr std::uint64_t sweeps_between_questions = 4;

/// The sweeps of a solution, with what is stored in Real. Ends when solved, at the limit of sweeps, or, if
/// `most_failures` is above 0, when so many verifications have found it too large although the sweeps stood still.
template <class Real>
class Solver {
public:
    Solver(const ContactProblem& problem, const LcpSettings& settings, ContactSolution& solution)
        : problem_(problem),
          settings_(settings),
          solution_(solution),
          sweeper_(problem, settings.tolerance, solution.gamma) {
        sweeper_.refresh(solution_);
    }

    /// Whether nothing is left to be done: solved, and no contact missed; or lost, or interrupted.
    bool solve(SolverOutcome& outcome, int most_failures) {
        const bool warm = !problem_.start.empty();
        const std::uint64_t period = warm ? full_sweep_every_if_warm : full_sweep_every;
        bool look_at_all = false;
        std::uint64_t next_verification = 0;
        for (int failures = 0; outcome.iterations < settings_.max_iterations;) {
            const bool all = look_at_all || outcome.iterations % period == period - 1;
            const double omega = relaxation(outcome.iterations, problem_.matrix.compliant(), warm);
            const double change = problem_.time_step * sweeper_.sweep(omega, all ? SweepOver::all : SweepOver::awake);
            ++outcome.iterations;
            look_at_all = false;
            if (outcome.iterations % sweeps_between_questions == 0 && settings_.is_interrupted()) {
                outcome.status = LcpStatus::interrupted;
                return true;
            }
            if (outcome.iterations >= next_search_) {
                next_search_ = 3 * outcome.iterations;
                sweeper_.read_velocities(solution_.velocities);
                if (add_missed(false)) continue;
            }
            // The residual is near the last change; it is computed where that is small, and now and then for the
            // paper's norm.
            const bool small = settings_.residual == LcpResidual::length ? !(change > settings_.tolerance)
                                                                         : outcome.iterations >= next_verification;
            if (!small && outcome.iterations < settings_.max_iterations) continue;
            if (verified(outcome)) return true;
            // What rests may have been left too long: that is no failure of the sweeps.
            const bool failed = outcome.status != LcpStatus::converged && (all || !warm);
            if (failed && ++failures == most_failures) return false;
            look_at_all = true;
            next_verification = outcome.iterations + 5;
        }
        return false;
    }

    /// The same for the solution as it is, without a sweep.
    bool verified(SolverOutcome& outcome) {
        verify(outcome);
        if (outcome.status == LcpStatus::not_finite) return true;
        if (outcome.status != LcpStatus::converged) return false;
        ++outcome.solves;
        return !add_missed(true);
    }

    /// Residual and status, over all contacts, from gamma alone.
    void verify(SolverOutcome& outcome) {
        sweeper_.refresh(solution_);
        LcpResult result;
        result.velocity.resize(problem_.matrix.size());
        problem_.matrix.rates(solution_.velocities, solution_.gamma, result.velocity);
        parallel_for(result.velocity.size(), [&](std::size_t l) { result.velocity[l] += problem_.constant[l]; });
        result.solution.swap(solution_.gamma);
        result.residual = lcp_residual(problem_.lcp(), settings_.residual, result.solution, result.velocity);
        outcome.status = lcp_status(problem_.lcp(), settings_, result);
        outcome.residual = result.residual;
        result.solution.swap(solution_.gamma);
    }

private:
    bool add_missed(bool final) {
        if (!problem_.add_missed || !problem_.add_missed(solution_, final)) return false;
        solution_.resize(problem_.matrix.contact_matrix());
        sweeper_.extend();
        return true;
    }

    const ContactProblem& problem_;
    const LcpSettings& settings_;
    ContactSolution& solution_;
    Sweeper<Real> sweeper_;
    std::uint64_t next_search_ = early_search;
};

}  // namespace

SolverOutcome solve_projected_sor(const ContactProblem& problem, const LcpSettings& settings,
                                  ContactSolution& solution) {
    SolverOutcome outcome;
    solution.resize(problem.matrix.contact_matrix());
    const auto& b = problem.constant;
    const double deepest = parallel_max(b.size(), 0.0, [&](std::size_t l) { return -b[l]; });
    const bool in_float = settings.residual == LcpResidual::length && std::isfinite(deepest) &&
                          settings.tolerance > finest_in_float * problem.time_step * deepest;
    if (in_float) {
        Solver<float> solver(problem, settings, solution);
        if (deepest == 0.0 && solver.verified(outcome)) return outcome;
        if (solver.solve(outcome, patience_with_float)) return outcome;
    }
    Solver<double> solver(problem, settings, solution);
    if (!solver.verified(outcome) && !solver.solve(outcome, 0)) solver.verify(outcome);
    return outcome;
}

}  // namespace jostle
