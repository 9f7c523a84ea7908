#include <doctest/doctest.h>

#include "dense_operator.hpp"
#include "jostle/lcp/lcp_problem.hpp"

using namespace jostle;
using jostle::test::DenseOperator;

TEST_CASE("the default residual is a length that does not change with units; the paper's does") {
    const DenseOperator A(Eigen::MatrixXd::Constant(1, 1, 4.0));
    const std::vector<double> b{-2.0}, gamma{0.4};
    const std::vector<double> velocity{4.0 * 0.4 - 2.0};
    const LcpProblem problem{A, b, 0.5};
    CHECK(lcp_residual(problem, LcpResidual::length, gamma, velocity) == doctest::Approx(0.2));
    CHECK(lcp_residual(problem, LcpResidual::paper, gamma, velocity) == doctest::Approx(0.4));
    // Forces in units 1000 times smaller: gamma -> 1000 gamma, A -> A/1000.
    const DenseOperator rescaled(Eigen::MatrixXd::Constant(1, 1, 0.004));
    const std::vector<double> gamma_rescaled{400.0};
    const LcpProblem same{rescaled, b, 0.5};
    CHECK(lcp_residual(same, LcpResidual::length, gamma_rescaled, velocity) == doctest::Approx(0.2));
}
