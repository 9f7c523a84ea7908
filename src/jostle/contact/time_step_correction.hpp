#pragma once

#include <cmath>

#include "jostle/contact/contact_compliance.hpp"

namespace jostle {

// A step sees the other rod at its ends only. Its gaps are therefore shifted, its contacts are compliant, and its
// normals are those half way through the known motion (theory, section 3; docs/decisions/0015-compliant-contacts.md).

/// kappa and kappa': of contacts that begin to push, and of those pushed hard. Chosen for crowds.
inline constexpr double soft_compliance = 8.0, stiff_compliance = 0.05;

/// s and d: a gap is shifted by s sigma, with sigma^2 = 2 kT dt A_ll the variance of a step along the normal, and a
/// contact that has given way by d sigma becomes stiff.
///
/// A Gaussian walk of variance sigma^2 a step in front of such a wall then has as many walkers, and their mean place,
/// as continuous motion in front of a hard one. tests/unit/contact/test_time_step_correction.cpp solves for both.
inline constexpr double discrete_watching = 1.9388318171260;
inline constexpr double give_before_stiff = 1.6587265430176;

/// A rod and its own image stand alone between two walls, in narrow boxes a few steps apart: a spring that acts over a
/// shorter distance serves better. kappa of one spring, and the shift that gives it as many walkers.
inline constexpr double own_image_compliance = 0.25, own_image_watching = 0.7380301893698;

/// Normals and arms of contacts are those after this part of the known motion.
inline constexpr double normals_after_part = 0.5;

/// The shift s sqrt(2 kT dt A_ll) of a gap whose rods have the relative mobility A_ll along the normal.
inline double brownian_shift(double kT, double time_step, double relative_mobility, double s = discrete_watching) {
    return s * std::sqrt(2.0 * kT * time_step * relative_mobility);
}

/// The compliance of the contacts of a step: none without thermal motion.
inline ComplianceLaw brownian_compliance(double kT, double time_step) {
    if (kT == 0.0) return {};
    const double sigma = std::sqrt(2.0 * kT / time_step);  // as a velocity, over the root of A_ll
    return {soft_compliance, stiff_compliance, (1.0 - stiff_compliance / soft_compliance) * give_before_stiff * sigma,
            own_image_compliance};
}

}  // namespace jostle
