#include "jostle/contact_problem/near_first.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "jostle/lcp/adaptive_bb.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

/// Violated pairs are looked for early from so many tolerances on.
constexpr double early_search_tolerances = 30.0;
/// The near part is solved to this part of the residual, and no finer than to this part of the tolerance.
constexpr double near_part = 0.05, finest_near_part = 0.2;
constexpr std::uint64_t max_near_applications = 300;

}  // namespace

NearFirst::NearFirst(const ContactProblem& problem, const LcpSettings& settings) : ContactSolver(problem, settings) {
    if (problem.start().empty()) return;
    problem_.complete(solution_);
    ++outcome_.iterations;
}

bool NearFirst::run_to_next_stop() {
    const bool begins = std::exchange(begins_, false), grown = problem_has_grown();
    if (at_solution_ && !grown) return false;
    if (!among_ || grown) among_.emplace(problem_.matrix());
    if (begins || at_solution_)
        velocity_ = rates_of_velocities();
    else if (grown)
        velocity_ = rates_of_forces();
    if (at_solution_ || begins) ++outcome_.solves;
    at_solution_ = false;
    for (;;) {
        const double now = residual();
        if (now <= settings_.tolerance) {
            if (const double all = verified(); all <= settings_.tolerance) return end(all);
            continue;
        }
        if (!std::isfinite(now) || outcome_.iterations >= settings_.max_iterations || settings_.is_interrupted())
            return end(now);
        if (!searched_early_ && now <= early_search_tolerances * settings_.tolerance) return stop_at_candidate();
        improve(now);
    }
}

void NearFirst::begin_again(double tolerance) {
    ContactSolver::begin_again(tolerance);
    std::fill(solution_.velocities.begin(), solution_.velocities.end(), ContactVelocity{});
    begins_ = true;
    searched_early_ = false;
}

/// A gamma + b of all contacts, from the velocities of all rods, if these are those of the whole mobility.
std::vector<double> NearFirst::rates_of_velocities() const {
    std::vector<double> rates(problem_.size());
    problem_.gap_velocities(solution_, rates);
    return rates;
}

/// The same, from gamma.
std::vector<double> NearFirst::rates_of_forces() {
    std::vector<double> rates(problem_.size());
    among_->whole().apply(solution_.gamma, rates);
    ++outcome_.iterations;
    parallel_for(rates.size(), [&](std::size_t l) { rates[l] += problem_.constant()[l]; });
    return rates;
}

double NearFirst::residual() const {
    return lcp_residual(problem_.lcp(), settings_.residual, solution_.gamma, velocity_);
}

/// The residual with the velocities of all rods as they follow from gamma.
double NearFirst::verified() {
    problem_.complete(solution_);
    ++outcome_.iterations;
    velocity_ = rates_of_velocities();
    return residual();
}

/// Pairs that come together are looked for with the velocities of the near field, which are cheap. What these do not
/// show, the search at the solution finds.
bool NearFirst::stop_at_candidate() {
    searched_early_ = true;
    problem_.complete(solution_, DelassusOperator::Reach::near);
    return true;
}

bool NearFirst::end(double residual) {
    LcpResult result{.solution = solution_.gamma, .velocity = velocity_, .residual = residual};
    outcome_.status = lcp_status(problem_.lcp(), settings_, result);
    if (outcome_.status != LcpStatus::converged && settings_.is_interrupted()) outcome_.status = LcpStatus::interrupted;
    outcome_.residual = residual;
    at_solution_ = outcome_.status == LcpStatus::converged;
    return at_solution_;
}

void NearFirst::improve(double residual) {
    std::vector<double>& gamma = solution_.gamma;
    std::vector<double> constant(gamma.size()), image(gamma.size());
    among_->near().apply(gamma, constant);
    parallel_for(gamma.size(), [&](std::size_t l) { constant[l] = velocity_[l] - constant[l]; });
    LcpSettings near_settings = settings_;
    near_settings.tolerance = std::max(near_part * residual, finest_near_part * settings_.tolerance);
    near_settings.max_iterations = max_near_applications;
    const LcpProblem near{among_->near(), constant, problem_.time_step()};
    std::vector<double> step = solve_adaptive_bb(near, near_settings, gamma).solution;
    parallel_for(gamma.size(), [&](std::size_t l) { step[l] -= gamma[l]; });
    among_->whole().apply(step, image);
    ++outcome_.iterations;
    const double slope = parallel_sum<double>(gamma.size(), [&](std::size_t l) { return step[l] * velocity_[l]; });
    const double curvature = parallel_sum<double>(gamma.size(), [&](std::size_t l) { return step[l] * image[l]; });
    const double length = curvature > 0.0 ? std::clamp(-slope / curvature, 0.0, 1.0) : 1.0;
    parallel_for(gamma.size(), [&](std::size_t l) {
        gamma[l] = std::max(gamma[l] + length * step[l], 0.0);
        velocity_[l] += length * image[l];
    });
}

}  // namespace jostle
