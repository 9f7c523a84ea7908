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
    } else if (++sweeps_since_least_ == (use_ == Use::for_speed ? patience : last_patience)) {
        if (use_ == Use::for_speed) largest_beta_ = 1.0 - 2.0 * (1.0 - largest_beta_);
        return restart();
    }
    const double least = use_ == Use::for_speed ? least_change_ : least_with_these_contacts_;
    const bool grows = change > growth * least;
    if (grows && use_ == Use::for_speed) ++growths_;
    if (grows && use_ == Use::as_last_resort) rests_ = sweeps_of_rest;
    if (grows || turned_back) return lose_momentum();
    least_change_ = std::min(least_change_, change);
    const double next = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * theta_ * theta_));
    beta_ = std::min((theta_ - 1.0) / next, largest_beta_);
    theta_ = next;
}

}  // namespace jostle
