#include "jostle/contact_problem/projected_sor.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "jostle/contact_problem/block_gauss_seidel.hpp"
#include "jostle/contact_problem/previous_forces.hpp"
#include "jostle/contact_problem/sweep_momentum.hpp"
#include "jostle/parallel/sum_over_ranks.hpp"

namespace jostle {

namespace {

/// Over-relaxation: measured best between 1.1 and 1.4 for dilute and isotropic rods; harder problems want more, and so
/// do those that begin warm, with what is left to the slowest modes of a crowd, where momentum has failed.
double relaxation(std::uint64_t sweep, bool warm) {
    return sweep >= 60 || warm ? 1.6 : 1.2;
}

/// Every so many sweeps, and after a verification, one passes over all contacts.
constexpr std::uint64_t full_sweep_every = 5;
/// Sweeps in float are right to about 1e-6 of the deepest overlap, and finer tolerances are left to double.
constexpr double finest_in_float = 1e-5;
/// Double takes over where so many verifications have found more residual than the sweeps in float had left to do.
constexpr int patience_with_float = 3;
/// After this sweep, and three times as many, and so on, violated pairs are looked for before the sweeps have settled.
constexpr std::uint64_t early_search = 6;
/// And where a contact changes by no more than so many tolerances.
constexpr double search_tolerances = 10.0;
/// Momentum is quick to this part of the deepest overlap, and stands still before finer tolerances.
constexpr double finest_with_momentum = 2e-3;
/// With momentum, once in so many sweeps of the first 32, and then once in so many.
constexpr std::uint64_t sweeps_between_searches = 8, many_sweeps = 32, sweeps_between_late_searches = 16;
/// Beginning warm, candidates from so many tolerances on are nearly the solution.
constexpr double near_tolerances = 10.0;
/// With momentum single contacts change by far more than they violate their conditions. That is looked at once in so
/// many sweeps, where changes are below so many tolerances; the residual is computed if it is this part of a tolerance.
constexpr std::uint64_t sweeps_between_looks = 4;
constexpr double first_look_tolerances = 30.0, solved_part = 0.95;
/// Every so many sweeps it is asked whether to go on.
constexpr std::uint64_t sweeps_between_questions = 4;

}  // namespace

/// The sweeps of a solution, with what is stored in Real.
template <class Real>
class ProjectedSor::Sweeps {
public:
    enum class End {
        candidate,  ///< forces that still change: violated pairs are looked for early
        solution,   ///< of the problem as it is
        lost,       ///< not finite, or interrupted
        given_up,   ///< no sweep is left, or verifications have found too large a residual although the sweeps stood
                    ///< still
    };

    /// `max_failures`: so many such verifications; 0: any number. `verify_first`: before any sweep.
    Sweeps(const ContactProblem& problem, const LcpSettings& settings, ContactSolution& solution,
           SolverOutcome& outcome, int max_failures, bool verify_first, bool may_have_momentum)
        : problem_(problem),
          settings_(settings),
          solution_(solution),
          outcome_(outcome),
          max_failures_(max_failures),
          verify_first_(verify_first),
          warm_(problem.begins_warm()),
          may_have_momentum_(may_have_momentum),
          gauss_seidel_(problem, settings.tolerance, solution.gamma, settings.colours_per_exchange) {
        gauss_seidel_.refresh(solution_);
    }

    /// With the constants that the problem has now, from no forces. `verify_first`: before any sweep.
    void begin_again(bool verify_first) {
        gauss_seidel_.begin_again(settings_.tolerance);
        warm_ = may_have_momentum_ = at_candidate_ = sweep_all_ = is_near_ = found_more_ = false;
        verify_first_ = verify_first;
        begun_ = outcome_.iterations;
        next_search_ = begun_ + early_search;
        next_verification_ = 0;
        failures_ = 0;
        change_ = 0.0;
    }

    /// Goes on after the last end; `grown`: the problem has more contacts since.
    End run(bool grown) {
        if (grown) {
            gauss_seidel_.extend();
            momentum_.expect_larger_changes();
            found_more_ = true;
        }
        bool sweep_is_judged = !std::exchange(at_candidate_, false) || grown;
        if (std::exchange(verify_first_, false) && verify()) return verified_end();
        for (;;) {
            if (sweep_is_judged) {
                if (outcome_.iterations >= settings_.max_iterations) return End::given_up;
                sweep();
                if (is_interrupted()) return End::lost;
                if (is_time_to_search()) return End::candidate;
            }
            sweep_is_judged = true;
            if (!may_be_solved()) continue;
            const bool decided = verify();
            const bool settled = !(change_ > settings_.tolerance);
            if (!decided && settled && ++failures_ == max_failures_) return End::given_up;
            sweep_all_ = true;
            if (!decided) gauss_seidel_.stir_all();  // many changes that were too small to be told may add up
            next_verification_ = outcome_.iterations + 5;
            if (decided) return verified_end();
        }
    }

    /// Residual and status, over all contacts, from gamma alone. Returns whether the status decides: solved, or not
    /// finite.
    bool verify() {
        gauss_seidel_.refresh(solution_);
        LcpResult result;
        result.velocity.resize(problem_.size());
        problem_.gap_velocities(solution_, result.velocity);
        result.solution.swap(solution_.gamma);
        result.residual = lcp_residual(problem_.lcp(), settings_.residual, result.solution, result.velocity);
        outcome_.status = lcp_status(problem_.lcp(), settings_, result);
        outcome_.residual = result.residual;
        result.solution.swap(solution_.gamma);
        return outcome_.status == LcpStatus::converged || outcome_.status == LcpStatus::not_finite;
    }

    /// Whether the last sweep changed no gap by much; with momentum, whether this is not the first search.
    bool is_near_solution() const {
        if (has_momentum()) return outcome_.iterations > sweeps_between_searches;
        return warm_ && change_ <= near_tolerances * settings_.tolerance;
    }

private:
    void sweep() {
        change_ = problem_.time_step() * (has_momentum() ? sweep_on() : sweep_over_relaxed());
        ++outcome_.iterations;
    }

    double sweep_on() {
        const double change = gauss_seidel_.sweep_on(momentum_.beta());
        momentum_.advance(change);
        return change;
    }

    double sweep_over_relaxed() {
        const std::uint64_t sweeps = outcome_.iterations - begun_;
        const bool all = std::exchange(sweep_all_, false) || sweeps % full_sweep_every == full_sweep_every - 1;
        const double omega = relaxation(sweeps, warm_);
        return gauss_seidel_.sweep(omega, all ? SweepOver::all : SweepOver::active);
    }

    bool is_interrupted() {
        if (outcome_.iterations % sweeps_between_questions != 0) return false;
        if (!problem_.domain().ranks().any(settings_.is_interrupted())) return false;
        outcome_.status = LcpStatus::interrupted;
        return true;
    }

    bool is_time_to_search() {
        if (!has_come_to_next_search()) return false;
        plan_next_search();
        gauss_seidel_.read_velocities(solution_);
        at_candidate_ = true;
        return true;
    }

    /// After the search at this stop.
    void plan_next_search() {
        next_search_ = outcome_.iterations + sweeps_to_next_search(outcome_.iterations - begun_);
        is_near_ = change_ <= search_tolerances * settings_.tolerance;
        found_more_ = false;
    }

    /// After so many sweeps.
    std::uint64_t sweeps_to_next_search(std::uint64_t sweeps) const {
        if (!has_momentum()) return 2 * sweeps;
        return sweeps < many_sweeps ? sweeps_between_searches : sweeps_between_late_searches;
    }

    /// Contacts that are found at the solution cost as many sweeps again: without momentum, if there were new ones at
    /// the last search, the next one is before that.
    bool has_come_to_next_search() const {
        if (outcome_.iterations >= next_search_) return true;
        return !has_momentum() && !is_near_ && found_more_ && change_ <= search_tolerances * settings_.tolerance;
    }

    bool has_momentum() const { return may_have_momentum_ && momentum_.is_trusted(); }

    /// The residual is near the last change, or below it, with momentum far below. It is computed where it seems to be
    /// small, and now and then for the paper's norm.
    bool may_be_solved() {
        if (outcome_.iterations >= settings_.max_iterations) return true;
        const bool may_be_verified = outcome_.iterations >= next_verification_;
        if (settings_.residual != LcpResidual::length) return may_be_verified;
        if (!(change_ > settings_.tolerance)) return true;
        const bool may_be_near = has_momentum() && change_ <= first_look_tolerances * settings_.tolerance;
        if (!may_be_near || outcome_.iterations % sweeps_between_looks != 0) return false;
        return problem_.time_step() * gauss_seidel_.violation() <= solved_part * settings_.tolerance;
    }

    End verified_end() {
        if (outcome_.status == LcpStatus::not_finite) return End::lost;
        ++outcome_.solves;
        plan_next_search();
        return End::solution;
    }

    const ContactProblem& problem_;
    const LcpSettings& settings_;
    ContactSolution& solution_;
    SolverOutcome& outcome_;
    int max_failures_, failures_ = 0;
    bool verify_first_, warm_, may_have_momentum_;
    BlockGaussSeidel<Real> gauss_seidel_;
    SweepMomentum momentum_;
    std::uint64_t begun_ = 0;  ///< sweeps before it began again
    std::uint64_t next_search_ = early_search, next_verification_ = 0;
    bool is_near_ = false;     ///< whether the last search was nearly at the solution
    bool found_more_ = false;  ///< by the last search
    bool at_candidate_ = false, sweep_all_ = false;
    double change_ = 0.0;  ///< of a gap by the last sweep, at most
};

ProjectedSor::ProjectedSor(const ContactProblem& problem, const LcpSettings& settings)
    : ContactSolver(problem, settings) {
    const double overlap = deepest_overlap();
    may_have_momentum_ = settings_.tolerance > finest_with_momentum * overlap && is_crowd(pushing_at_start()) &&
                         !problem.matrix().opens_box();
    if (is_fine_enough_in_float(overlap))
        in_float_ = std::make_unique<Sweeps<float>>(problem, settings_, solution_, outcome_, patience_with_float,
                                                    overlap == 0.0, may_have_momentum_);
}

ProjectedSor::~ProjectedSor() = default;

/// How many contacts push as the solver begins, on all ranks.
std::size_t ProjectedSor::pushing_at_start() const {
    const std::vector<double>& start = problem_.start();
    const auto elsewhere = problem_.is_elsewhere();
    return sum_over_ranks<std::size_t>(problem_.domain().ranks(), start.size(), [&](std::size_t l) {
        const bool counts = elsewhere.empty() || elsewhere[l] == 0;
        return counts && start[l] > 0.0 ? std::size_t{1} : 0;
    });
}

/// By how much the deepest of the gaps would be below 0 without forces, on all ranks.
double ProjectedSor::deepest_overlap() const {
    const std::vector<double>& b = problem_.constant();
    const double deepest = parallel_max(b.size(), 0.0, [&](std::size_t l) { return -b[l]; });
    return problem_.time_step() * problem_.domain().ranks().largest(deepest);
}

bool ProjectedSor::is_fine_enough_in_float(double overlap) const {
    return settings_.residual == LcpResidual::length && std::isfinite(overlap) &&
           settings_.tolerance > finest_in_float * overlap;
}

void ProjectedSor::begin_again(double tolerance) {
    ContactSolver::begin_again(tolerance);
    const double overlap = deepest_overlap();
    if (in_float_ && !is_fine_enough_in_float(overlap)) in_float_.reset();
    if (in_float_) in_float_->begin_again(overlap == 0.0);
    if (in_double_) in_double_->begin_again(overlap == 0.0);
}

bool ProjectedSor::run_to_next_stop() {
    const bool grown = problem_has_grown();
    if (std::exchange(at_solution_, false) && !grown) return false;
    const auto run = [&](auto& sweeps, bool with_new) {
        using End = typename std::remove_reference_t<decltype(sweeps)>::End;
        const End end = sweeps.run(with_new);
        at_solution_ = end == End::solution;
        at_near_candidate_ = end == End::candidate && sweeps.is_near_solution();
        return std::pair{at_solution_ || end == End::candidate, end == End::given_up};
    };
    if (in_float_) {
        const auto [stopped, given_up] = run(*in_float_, grown);
        if (!given_up) return stopped;
        in_float_.reset();
    }
    const bool known = in_double_ != nullptr;
    if (!known)
        in_double_ =
            std::make_unique<Sweeps<double>>(problem_, settings_, solution_, outcome_, 0, true, may_have_momentum_);
    const auto [stopped, given_up] = run(*in_double_, known && grown);
    if (given_up) in_double_->verify();
    return stopped;
}

}  // namespace jostle
