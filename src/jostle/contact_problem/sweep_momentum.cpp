#include "jostle/contact_problem/sweep_momentum.hpp"

#include <algorithm>
#include <cmath>

namespace jostle {

void SweepMomentum::restart() {
    theta_ = 1.0;
    beta_ = 0.0;
    least_change_ = std::numeric_limits<double>::infinity();
}

void SweepMomentum::advance(double change, bool turned_back) {
    const bool grows = change > growth * least_change_;
    if (grows) ++growths_;
    if (grows || turned_back) return restart();
    least_change_ = std::min(least_change_, change);
    const double next = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * theta_ * theta_));
    beta_ = std::min((theta_ - 1.0) / next, largest_beta);
    theta_ = next;
}

}  // namespace jostle
