#pragma once

#include <Eigen/Dense>

#include "jostle/lcp/linear_operator.hpp"

namespace jostle::test {

/// A matrix given by its elements, as a LinearOperator.
class DenseOperator final : public LinearOperator {
public:
    explicit DenseOperator(Eigen::MatrixXd matrix) : matrix_(std::move(matrix)), diagonal_(matrix_.diagonal()) {}
    std::size_t size() const override { return static_cast<std::size_t>(matrix_.rows()); }
    void apply(std::span<const double> x, std::span<double> result) const override {
        const auto count = static_cast<Eigen::Index>(x.size());
        Eigen::Map<Eigen::VectorXd>(result.data(), count) =
            matrix_ * Eigen::Map<const Eigen::VectorXd>(x.data(), count);
    }
    std::span<const double> diagonal() const override { return {diagonal_.data(), size()}; }
    const Eigen::MatrixXd& matrix() const { return matrix_; }

private:
    Eigen::MatrixXd matrix_;
    Eigen::VectorXd diagonal_;
};

}  // namespace jostle::test
