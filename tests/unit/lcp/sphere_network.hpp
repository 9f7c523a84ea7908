#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <cmath>
#include <random>

#include "jostle/lcp/linear_operator.hpp"

namespace jostle::test {

/// How far spheres are from their lattice, in units of its constant. Under a sanitizer one of them: networks take fifty
/// times as long there.
#ifdef JOSTLE_SANITIZED
inline constexpr double jitters[] = {0.15};
#else
inline constexpr double jitters[] = {0.05, 0.15, 0.3};
#endif

/// The contact problem of spheres on a jittered cubic lattice, of very different sizes, so that A_ll differ tenfold.
///
/// A = D^T M D with M_i = 1/diameter_i, as of Stokes drag. The lattice is not periodic, so a solution exists.
class SphereNetwork final : public LinearOperator {
public:
    /// edge^3 spheres; the jitter is in units of the lattice constant.
    SphereNetwork(int edge, double jitter, unsigned seed) {
        std::mt19937_64 engine(seed);
        std::normal_distribution<double> normal;
        std::uniform_real_distribution<double> uniform(0.5, 1.5);
        std::vector<Eigen::Vector3d> centre;
        std::vector<double> diameter;
        for (int k = 0; k < edge * edge * edge; ++k) {
            const Eigen::Vector3d noise(normal(engine), normal(engine), normal(engine));
            centre.push_back(Eigen::Vector3d(k % edge, k / edge % edge, k / (edge * edge)) + jitter * noise);
            diameter.push_back(uniform(engine));
        }
        std::vector<Eigen::Triplet<double>> elements;
        for (std::size_t j = 0; j < centre.size(); ++j) {
            for (std::size_t i = 0; i < j; ++i) {
                const Eigen::Vector3d apart = centre[j] - centre[i];
                const double gap = apart.norm() - 0.5 * (diameter[i] + diameter[j]);
                if (gap > 0.3) continue;
                for (int axis = 0; axis < 3; ++axis) {
                    const double direction = apart.normalized()(axis);
                    const auto contact = static_cast<int>(constant_.size());
                    elements.emplace_back(static_cast<int>(3 * i) + axis, contact, -direction / std::sqrt(diameter[i]));
                    elements.emplace_back(static_cast<int>(3 * j) + axis, contact, direction / std::sqrt(diameter[j]));
                }
                constant_.push_back(gap);
            }
        }
        rows_.resize(static_cast<int>(3 * centre.size()), static_cast<int>(constant_.size()));
        rows_.setFromTriplets(elements.begin(), elements.end());
        for (int l = 0; l < rows_.cols(); ++l) diagonal_.push_back(rows_.col(l).squaredNorm());
    }

    std::size_t size() const override { return constant_.size(); }
    void apply(std::span<const double> x, std::span<double> result) const override {
        const auto count = static_cast<Eigen::Index>(x.size());
        const Eigen::VectorXd velocity = rows_ * Eigen::Map<const Eigen::VectorXd>(x.data(), count);
        Eigen::Map<Eigen::VectorXd>(result.data(), count) = rows_.transpose() * velocity;
    }
    std::span<const double> diagonal() const override { return diagonal_; }
    std::span<const double> constant() const { return constant_; }  ///< b: the gaps

private:
    Eigen::SparseMatrix<double> rows_;  ///< M^(1/2) D
    std::vector<double> constant_, diagonal_;
};

}  // namespace jostle::test
