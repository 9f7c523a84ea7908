#pragma once

#include <cmath>

namespace jostle {

/// c = -zeta(1/2)/sqrt(2 pi): a Gaussian walk watched once a step, of variance sigma^2 a step, is reflected at a wall
/// as the continuous motion would be by a wall displaced by c sigma (Chernoff 1965; Siegmund 1979; theory, section 3).
inline constexpr double discrete_watching = 0.5825971579390107;

/// The shift c sqrt(2 kT dt A_ll) of a gap whose rods have the relative mobility A_ll along the normal.
inline double brownian_shift(double kT, double time_step, double relative_mobility) {
    return discrete_watching * std::sqrt(2.0 * kT * time_step * relative_mobility);
}

}  // namespace jostle
