#pragma once

#include <array>

#include "jostle/math/mat3.hpp"

namespace jostle {

struct SymmetricEigen {
    std::array<double, 3> values;  ///< ascending
    std::array<Vec3, 3> vectors;   ///< unit vectors, vectors[k] belongs to values[k]
};

/// Eigenvalues and eigenvectors of the symmetric part of a 3 x 3 matrix.
SymmetricEigen symmetric_eigen(const Mat3& matrix);

}  // namespace jostle
