#pragma once

#include <cmath>

namespace jostle {

// A step sees the other rod at its ends only. Its gaps are therefore shifted, and its contacts made a little compliant
// (theory, section 3; docs/decisions/0015-compliant-contacts.md).

/// kappa: a contact with the force gamma leaves its gap kappa A_ll gamma dt below the shift. Any value is right for two
/// rods alone if the shift belongs to it; this one makes up for rods that are held from several sides.
inline constexpr double contact_compliance = 0.25;

/// s(kappa): a Gaussian walk of variance sigma^2 a step, whose ends beyond a wall are brought back to within
/// kappa/(1 + kappa) of their distance, is as continuous motion reflected at a wall displaced by s sigma. For kappa = 0
/// that is -zeta(1/2)/sqrt(2 pi) = 0.5826 (Chernoff 1965; Siegmund 1979).
/// tests/unit/contact/test_time_step_correction.cpp solves for it.
inline constexpr double discrete_watching = 0.7380301893698;

/// The shift s(kappa) sqrt(2 kT dt A_ll) of a gap whose rods have the relative mobility A_ll along the normal.
inline double brownian_shift(double kT, double time_step, double relative_mobility) {
    return discrete_watching * std::sqrt(2.0 * kT * time_step * relative_mobility);
}

}  // namespace jostle
