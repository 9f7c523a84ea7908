#pragma once

#include <cmath>
#include <vector>

#include "jostle/contact/contacts.hpp"

// The soft repulsion that hard rods are often replaced by (Weeks, Chandler and Andersen, J. Chem. Phys. 54, 5237
// (1971)), between the nearest points of two segments at the distance r, with D = (D_i + D_j)/2:
//     U(r) = 4 epsilon [(D/r)^12 - (D/r)^6] + epsilon  for r < 2^(1/6) D, else 0.

namespace jostle {

/// Where the potential ends, over the diameter: 2^(1/6).
inline constexpr double wca_range = 1.122462048309373;

/// Force -dU/dr >= 0 of two points at `distance` > 0 (length), for `diameter` > 0 (length) and `energy` epsilon.
inline double wca_force(double distance, double diameter, double energy) {
    if (distance >= wca_range * diameter) return 0.0;
    const double ratio = diameter / distance;
    const double sixth = std::pow(ratio, 6);
    return 24.0 * energy / distance * sixth * (2.0 * sixth - 1.0);
}

/// Curvature d2U/dr2 where U = `height` >= 0 (energy), for `diameter` > 0 (length) and `energy` epsilon > 0: with x =
/// (D/r)^6 = (1 + sqrt(U/epsilon))/2 it is 4 epsilon (156 x^2 - 42 x)/r^2.
inline double wca_curvature(double height, double diameter, double energy) {
    const double x = 0.5 * (1.0 + std::sqrt(height / energy));
    return 4.0 * energy * x * (156.0 * x - 42.0) * std::cbrt(x) / (diameter * diameter);
}

/// One force a contact. A pair feels its potential once: at its nearest points, or, where the ends of the stretch along
/// which it lies side by side stand for them, at these in equal parts. A wall repels each end of a rod by itself, as
/// the surface of another rod at the same gap does.
std::vector<double> wca_forces(const Contacts& contacts, const Rods& rods, double energy);

}  // namespace jostle
