#pragma once

#include <span>

#include "jostle/math/mat3.hpp"
#include "jostle/rods/rods.hpp"

namespace jostle {

// What rods in a fluid exert on it as stresslets along their axes n, times the volume: energies, positive in
// compression, symmetric, traceless (theory, eq. 7.13). Parts of the suspension's stress, not of the collision stress.

/// Of swimmers, sum over rods of p (n n - I/3). `dipole` (N): p, an energy, > 0 of pushers.
Mat3 sum_of_dipole_stresses(const Rods& rods, std::span<const double> dipole);

/// Of thermal turning, sum over rods of -3 kT (n n - I/3), without spheres, whose axes are no part of their bodies.
Mat3 sum_of_thermal_stresses(const Rods& rods, double kT);

}  // namespace jostle
