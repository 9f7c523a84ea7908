#include "jostle/contact_problem/sweep_momentum.hpp"

#include <algorithm>

namespace jostle {

double SweepMomentum::beta() const {
    return sweeps_ == 0 ? 0.0 : std::min(std::max(0.8, 1.0 - 8.0 / sweeps_), largest_beta_);
}

void SweepMomentum::expect_larger_changes() {
    least_change_ = std::numeric_limits<double>::infinity();
    sweeps_since_least_ = 0;
}

void SweepMomentum::restart() {
    sweeps_ = 0;
    expect_larger_changes();
}

void SweepMomentum::advance(double change) {
    if (change > growth * least_change_) {
        ++growths_;
        return restart();
    }
    if (change < least_change_) {
        least_change_ = change;
        sweeps_since_least_ = 0;
    } else if (++sweeps_since_least_ == patience) {
        largest_beta_ = 1.0 - 2.0 * (1.0 - beta());
        return restart();
    }
    ++sweeps_;
}

}  // namespace jostle
