#include "jostle/math/symmetric_eigen.hpp"

#include <Eigen/Eigenvalues>

namespace jostle {

SymmetricEigen symmetric_eigen(const Mat3& matrix) {
    Eigen::Matrix3d symmetric;
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) symmetric(a, b) = 0.5 * (matrix(a, b) + matrix(b, a));
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(symmetric);
    SymmetricEigen result;
    for (int k = 0; k < 3; ++k) {
        const auto column = solver.eigenvectors().col(k);
        result.values[static_cast<std::size_t>(k)] = solver.eigenvalues()(k);
        result.vectors[static_cast<std::size_t>(k)] = {column(0), column(1), column(2)};
    }
    return result;
}

}  // namespace jostle
