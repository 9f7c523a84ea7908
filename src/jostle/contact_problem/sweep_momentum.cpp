#include "jostle/contact_problem/sweep_momentum.hpp"

#include <algorithm>
#include <cmath>

namespace jostle {

void SweepMomentum::restart() {
    lose_momentum();
    least_with_these_contacts_ = std::numeric_limits<double>::infinity();
    sweeps_since_least_ = 0;
}

void SweepMomentum::lose_momentum() {
    theta_ = 1.0;
    beta_ = 0.0;
    least_change_ = std::numeric_limits<double>::infinity();
}

void SweepMomentum::advance(double change, bool turned_back) {
    if (change < least_with_these_contacts_) {
        least_with_these_contacts_ = change;
        sweeps_since_least_ = 0;
    } else if (++sweeps_since_least_ == patience) {
        largest_beta_ = 1.0 - 2.0 * (1.0 - largest_beta_);
        return restart();
    }
    const bool grows = change > growth * least_change_;
    if (grows) ++growths_;
    if (grows || turned_back) return lose_momentum();
    least_change_ = std::min(least_change_, change);
    const double next = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * theta_ * theta_));
    beta_ = std::min((theta_ - 1.0) / next, largest_beta_);
    theta_ = next;
}

}  // namespace jostle
