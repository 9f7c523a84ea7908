#pragma once

#include <cstddef>
#include <span>

#include "jostle/math/mat3.hpp"

namespace jostle {

/// Order above which a state is called nematic. Isotropic phases of rods end below.
inline constexpr double nematic_above = 0.4;

/// Nematic order of a set of axes.
struct NematicOrder {
    Mat3 tensor;         ///< Q = <(3 n n - I)/2>, traceless
    double order = 0.0;  ///< S, the largest eigenvalue of Q: 1 aligned, 1/4 random in a plane, 0 isotropic
    Vec3 director;       ///< its unit eigenvector, its largest component positive: n and -n are the same
};

/// Q tensor, order S and director of the unit vectors `axes` (N, 3), N >= 1; heads and tails are not told apart.
///
/// The mean axis would vanish for rods without a head, so S is not taken from it. A finite isotropic set has S of the
/// order of 1/sqrt(N), not 0. In two dimensions Q = <2 n n - I> and S = sqrt(<cos 2a>^2 + <sin 2a>^2), 0 where axes are
/// random in the plane z = 0 (theory, eq. 9.3). Throws InputError if there is no axis.
NematicOrder nematic_order(std::span<const Vec3> axes, int dimensions = 3);
/// The same, of the sum of n n over so many axes.
NematicOrder nematic_order(const Mat3& sum, std::size_t count, int dimensions = 3);

}  // namespace jostle
