#pragma once

#include <functional>
#include <span>
#include <vector>

#include "jostle/hydrodynamics/line_vector.hpp"

namespace jostle {

/// A symmetric positive matrix, by what it does to a vector with one LineVector a rod.
using LineOperator = std::function<void(std::span<const LineVector> x, std::span<LineVector> result)>;

/// sqrt(A) x by Lanczos iteration (T. Ando, E. Chow, Y. Saad, J. Skolnick, J. Chem. Phys. 137, 064106 (2012)), until
/// one more application of A changes the result by less than `relative_change` of its norm.
///
/// Sums over rods are exact, so that neither threads nor rows change a bit.
std::vector<LineVector> times_square_root(const LineOperator& matrix, std::vector<LineVector> x,
                                          double relative_change);

}  // namespace jostle
