#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace jostle {

// A step sees the other rod at its ends only. Where Brownian motion would end a step beyond a surface, the path is
// therefore reflected there: mirrored, Brownian motion is Brownian motion (theory, section 3;
// docs/decisions/0061-reflected-steps.md).

/// kappa: a contact with the force gamma leaves its gap kappa A_ll gamma dt below 0. So little that averages do not
/// feel it; enough for A + kappa diag(A) to be positive definite, so that every contact problem has one solution.
inline constexpr double contact_compliance = 0.01;

/// Normals and arms of contacts are those after this part of the known motion: then a step and the same step backwards
/// see the same surfaces.
inline constexpr double normals_half_way = 0.5;

/// psi(x): by how much a normal number that exceeds x does so, in the mean, phi(x)/Q(x) - x; within 3 %.
inline double mean_excess(double x) {
    return (std::sqrt(x * x + 2.0 * std::numbers::pi) - x) / std::numbers::pi;
}

/// By how many times the force that would bring rods back to touching they are pushed (theory, eq. 3.5): 2 mirrors the
/// path, 1 leaves the rods at touching; at most 3, where surfaces are more curved than steps are short.
///
/// `overshoot`: by how far the gap would be below 0, > 0; `drift`: by how much the gap opens in a step without noise;
/// `sigma`: root mean square change of the gap by noise. All are lengths.
inline double reflected_part(double overshoot, double drift, double sigma) {
    if (!(sigma > 0.0)) return 1.0;
    return 1.0 + std::clamp(1.0 + 2.0 * (drift / sigma) * mean_excess(overshoot / sigma), 0.0, 2.0);
}

}  // namespace jostle
