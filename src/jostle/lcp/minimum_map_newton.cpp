#include "jostle/lcp/minimum_map_newton.hpp"

#include <algorithm>
#include <cmath>

#include "jostle/lcp/lcp_search.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

/// Of a trial step d: the change of the energy, and its slope along d before the step.
struct EnergyChange {
    double change = 0.0, slope = 0.0;
    EnergyChange& operator+=(const EnergyChange& other) {
        change += other.change;
        slope += other.slope;
        return *this;
    }
    bool falls() const { return slope < 0.0 && change <= 1e-4 * slope; }
};

class MinimumMapNewton {
public:
    MinimumMapNewton(LcpSearch& search, const LcpSettings& settings)
        : search_(search),
          tolerance_(settings.tolerance),
          weight_(inverse_diagonal(search.problem().matrix)),
          active_(weight_.size(), 2),
          direction_(weight_.size()),
          residual_(weight_.size()),
          conjugate_(weight_.size()),
          image_(weight_.size()) {}

    /// One iteration. False if neither a Newton step nor a projected gradient step lowers the energy.
    bool step() {
        const bool settled = !find_active();
        const double enough = 0.25 * tolerance_ / search_.current().residual;
        settled ? find_direction(std::min(enough, 0.1), 100) : find_direction(0.2, 10);
        if (try_steps(3)) return true;
        const auto& velocity = search_.current().velocity;
        parallel_for(weight_.size(), [&](std::size_t l) { direction_[l] = -weight_[l] * velocity[l]; });
        return try_steps(20);
    }

private:
    /// Marks the contacts whose velocity is to vanish; returns whether any mark changed.
    bool find_active() {
        const auto diagonal = search_.problem().matrix.diagonal();
        const std::vector<double>&gamma = search_.current().gamma, &velocity = search_.current().velocity;
        return parallel_sum<int>(active_.size(), [&](std::size_t l) {
                   const char before = active_[l];
                   active_[l] = diagonal[l] * gamma[l] > velocity[l];
                   return active_[l] != before ? 1 : 0;
               }) > 0;
    }

    /// The Newton direction: conjugate gradients reduce the velocities of active contacts to `reduction` of what they
    /// are after all other forces are gone, in at most `most` iterations.
    void find_direction(double reduction, int most) {
        const std::vector<double>&gamma = search_.current().gamma, &velocity = search_.current().velocity;
        parallel_for(active_.size(), [&](std::size_t l) { direction_[l] = active_[l] ? 0.0 : -gamma[l]; });
        parallel_for(active_.size(), [&](std::size_t l) { residual_[l] = active_[l] ? -velocity[l] : 0.0; });
        if (parallel_max(active_.size(), 0.0, [&](std::size_t l) { return std::fabs(direction_[l]); }) > 0.0) {
            search_.apply(direction_, image_);
            parallel_for(active_.size(), [&](std::size_t l) { residual_[l] -= active_[l] ? image_[l] : 0.0; });
        }
        parallel_for(active_.size(), [&](std::size_t l) { conjugate_[l] = weight_[l] * residual_[l]; });
        double rest = scaled_residual();
        const double goal = reduction * reduction * rest;
        for (int k = 0; k < most && rest > goal && search_.applications_left() > 1; ++k) {
            search_.apply(conjugate_, image_);
            if (!conjugate_gradient_step(rest)) return;
        }
    }

    /// residual.diag(1/A_ll) residual
    double scaled_residual() const {
        return parallel_sum<double>(residual_.size(),
                                    [&](std::size_t l) { return weight_[l] * residual_[l] * residual_[l]; });
    }

    /// False, and nothing changed, where the direction has no curvature beyond rounding.
    bool conjugate_gradient_step(double& rest) {
        const double curvature =
            parallel_sum<double>(image_.size(), [&](std::size_t l) { return conjugate_[l] * image_[l]; });
        const double length = parallel_sum<double>(
            image_.size(), [&](std::size_t l) { return conjugate_[l] * conjugate_[l] / weight_[l]; });
        if (!(curvature > 1e-14 * length)) return false;
        const double alpha = rest / curvature;
        parallel_for(image_.size(), [&](std::size_t l) {
            direction_[l] += alpha * conjugate_[l];
            residual_[l] -= active_[l] ? alpha * image_[l] : 0.0;
        });
        const double before = rest;
        rest = scaled_residual();
        parallel_for(image_.size(),
                     [&](std::size_t l) { conjugate_[l] = weight_[l] * residual_[l] + rest / before * conjugate_[l]; });
        return true;
    }

    /// Steps of 1, 1/2, 1/4, ... of the direction, projected; advances by the first good one.
    bool try_steps(int most) {
        const LcpIterate& now = search_.current();
        LcpIterate& next = search_.next();
        double length = 1.0;
        for (int k = 0; k < most && search_.applications_left() > 0; ++k, length *= 0.5) {
            parallel_for(direction_.size(),
                         [&](std::size_t l) { next.gamma[l] = std::max(now.gamma[l] + length * direction_[l], 0.0); });
            search_.apply_to_next();
            const auto energy = parallel_sum<EnergyChange>(direction_.size(), [&](std::size_t l) {
                const double d = next.gamma[l] - now.gamma[l];
                return EnergyChange{0.5 * d * (now.velocity[l] + next.velocity[l]), d * now.velocity[l]};
            });
            if (!energy.falls() && !search_.next_halves_best()) continue;
            search_.advance();
            return true;
        }
        return false;
    }

    LcpSearch& search_;
    double tolerance_;
    std::vector<double> weight_;
    std::vector<char> active_;       ///< 2 before the first iteration
    std::vector<double> direction_;  ///< the change of gamma
    std::vector<double> residual_, conjugate_,
        image_;  ///< of conjugate gradients, zero off the active contacts but image
};

}  // namespace

LcpResult solve_minimum_map_newton(const LcpProblem& problem, const LcpSettings& settings,
                                   std::span<const double> start) {
    LcpSearch search(problem, settings, start);
    if (!search.unsolved()) return search.result();
    MinimumMapNewton newton(search, settings);
    while (search.unsolved() && newton.step()) continue;
    return search.result();
}

}  // namespace jostle
