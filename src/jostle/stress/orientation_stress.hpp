#pragma once

#include "jostle/math/mat3.hpp"
#include "jostle/rods/rods.hpp"

namespace jostle {

/// Orientation stress of a rod times the volume, -3 kT B (n n - I/3) (theory, eq. 1.19): what its Brownian rotation
/// carries, as its Brownian translation carries kT I; energy, positive in compression, symmetric, traceless.
///
/// B of `moment_anisotropy`, as in the geometric stress: 0 for a sphere. `axis` n, a unit vector; `length` >= 0,
/// `diameter` > 0 and `kT` >= 0 are not checked. In two dimensions, where one angle diffuses, -2 kT B (n n - I/2)
/// (theory, eq. 9.4). Exactly 0 where kT or the length is.
Mat3 orientation_stress_of_rod(const Vec3& axis, double length, double diameter, double kT, int dimensions = 3);

/// Sum over rods of the orientation stress, V Sigma_ori, each with its own B. The same bits for any number of threads.
Mat3 sum_of_orientation_stresses(const Rods& rods, double kT, int dimensions = 3);

}  // namespace jostle
