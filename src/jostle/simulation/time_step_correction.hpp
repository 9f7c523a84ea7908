#pragma once

#include <cmath>

#include "jostle/simulation/giving_way.hpp"

namespace jostle {

// A step sees the other rod at its ends only. Its gaps are therefore shifted, its contacts give way, and its normals
// are those half way through the known motion (theory, section 3; docs/decisions/0015-compliant-contacts.md).

/// kappa of contacts that begin to push, and of those pushed hard. Chosen for crowds.
inline constexpr double soft_compliance = 8.0, stiff_compliance = 0.05;

/// d: where a contact has given way by d sigma, with sigma^2 = 2 kT dt A_ll the variance of a step along the normal, it
/// becomes stiff. And s: its gap is shifted by s sigma.
///
/// A Gaussian walk of variance sigma^2 a step in front of such a wall then has as many walkers, and their mean place,
/// as continuous motion in front of a hard one. tests/unit/simulation/test_time_step_correction.cpp solves for both.
inline constexpr double give_before_stiff = 1.6587265430176;
inline constexpr double discrete_watching = 1.9388318171260;

/// Normals and arms of contacts are those after this part of the known motion.
inline constexpr double half_way = 0.5;

/// The shift s sqrt(2 kT dt A_ll) of a gap whose rods have the relative mobility A_ll along the normal.
inline double brownian_shift(double kT, double time_step, double relative_mobility) {
    return discrete_watching * std::sqrt(2.0 * kT * time_step * relative_mobility);
}

/// How contacts give way in a step: none without thermal motion.
inline GivingWay brownian_giving_way(double kT, double time_step) {
    if (kT == 0.0) return {};
    const double sigma = std::sqrt(2.0 * kT / time_step);  // as a velocity, over the root of A_ll
    return {soft_compliance, stiff_compliance, (1.0 - stiff_compliance / soft_compliance) * give_before_stiff * sigma};
}

}  // namespace jostle
