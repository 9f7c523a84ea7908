#include "jostle/lcp/apgd.hpp"

#include <algorithm>
#include <cmath>

#include "jostle/lcp/lcp_search.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

/// Of a step d from the extrapolated point: d.diag(A) d, d.A d, and g.(gamma+ - gamma) with g the gradient there.
struct TrialProducts {
    double length = 0.0, curvature = 0.0, uphill = 0.0;
    TrialProducts& operator+=(const TrialProducts& other) {
        length += other.length;
        curvature += other.curvature;
        uphill += other.uphill;
        return *this;
    }
};

class AcceleratedDescent {
public:
    explicit AcceleratedDescent(LcpSearch& search)
        : search_(search),
          weight_(inverse_diagonal(search.problem().matrix)),
          gamma_(search.current().gamma),
          velocity_(search.current().velocity) {
        set_bound(1.0 / first_step_length(search, weight_));
    }

    /// One iteration. False if it stands still, or no application is left for a step to be taken anew.
    bool step() {
        TrialProducts products = try_step();
        while (products.curvature > bound_ * products.length) {
            if (search_.applications_left() == 0) return false;
            set_bound(std::max(products.curvature / products.length, 1.5 * bound_));
            products = try_step();
        }
        extrapolate(products.uphill > 0.0);
        search_.advance();
        set_bound(shrinking * bound_);
        return products.length > 0.0;
    }

private:
    static constexpr double shrinking = 0.97;

    void set_bound(double bound) { bound_ = std::max(bound, 0.1); }

    /// The projected step from the extrapolated point.
    TrialProducts try_step() {
        const LcpIterate& now = search_.current();
        LcpIterate& next = search_.next();
        const double length = 1.0 / bound_;
        parallel_for(gamma_.size(), [&](std::size_t l) {
            next.gamma[l] = std::max(gamma_[l] - length * weight_[l] * velocity_[l], 0.0);
        });
        search_.apply_to_next();
        return parallel_sum<TrialProducts>(gamma_.size(), [&](std::size_t l) {
            const double d = next.gamma[l] - gamma_[l];
            return TrialProducts{d * d / weight_[l], d * (next.velocity[l] - velocity_[l]),
                                 velocity_[l] * (next.gamma[l] - now.gamma[l])};
        });
    }

    /// Moves the extrapolated point on: beyond the next iterate, or to it for a restart.
    void extrapolate(bool restart) {
        const LcpIterate& now = search_.current();
        const LcpIterate& next = search_.next();
        const double theta = momentum_;
        momentum_ = restart ? 1.0 : 0.5 * theta * (std::sqrt(theta * theta + 4.0) - theta);
        const double beta = restart ? 0.0 : theta * (1.0 - theta) / (theta * theta + momentum_);
        parallel_for(gamma_.size(), [&](std::size_t l) {
            gamma_[l] = next.gamma[l] + beta * (next.gamma[l] - now.gamma[l]);
            velocity_[l] = next.velocity[l] + beta * (next.velocity[l] - now.velocity[l]);
        });
    }

    LcpSearch& search_;
    std::vector<double> weight_;
    std::vector<double> gamma_, velocity_;  ///< the extrapolated point, and A gamma + b there
    double bound_ = 1.0;                    ///< L
    double momentum_ = 1.0;                 ///< theta of Nesterov's sequence
};

}  // namespace

LcpResult solve_apgd(const LcpProblem& problem, const LcpSettings& settings, std::span<const double> start) {
    LcpSearch search(problem, settings, start);
    if (!search.unsolved()) return search.result();
    AcceleratedDescent descent(search);
    while (search.unsolved() && descent.step()) continue;
    return search.result();
}

}  // namespace jostle
