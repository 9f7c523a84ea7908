#include <doctest/doctest.h>

#include <random>

#include "dense_operator.hpp"
#include "jostle/lcp/bbpgd.hpp"

using namespace jostle;
using jostle::test::DenseOperator;

namespace {

LcpSettings tight(BarzilaiBorwein rule = BarzilaiBorwein::bb1) {
    LcpSettings settings;
    settings.tolerance = 1e-12;
    settings.step_rule = rule;
    return settings;
}

/// The solution's velocity A gamma + b by trying every set of active contacts: unique even where gamma is not.
Eigen::VectorXd velocity_by_enumeration(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
    const auto n = A.rows();
    for (unsigned set = 0; set < (1U << n); ++set) {
        std::vector<Eigen::Index> active;
        for (Eigen::Index l = 0; l < n; ++l)
            if (set >> l & 1U) active.push_back(l);
        Eigen::VectorXd gamma = Eigen::VectorXd::Zero(n);
        if (!active.empty()) {
            const Eigen::MatrixXd block = A(active, active);
            const Eigen::VectorXd part = block.completeOrthogonalDecomposition().solve(-b(active));
            if ((block * part + b(active)).norm() > 1e-9) continue;
            for (std::size_t k = 0; k < active.size(); ++k) gamma(active[k]) = part(static_cast<Eigen::Index>(k));
        }
        const Eigen::VectorXd velocity = A * gamma + b;
        if (gamma.minCoeff() > -1e-9 && velocity.minCoeff() > -1e-9) return velocity;
    }
    FAIL("no active set solves the problem");
    return {};
}

LcpResult solve(const DenseOperator& A, const Eigen::VectorXd& b, const LcpSettings& settings) {
    return solve_bbpgd({A, {b.data(), static_cast<std::size_t>(b.size())}, 1.0}, settings);
}

}  // namespace

TEST_CASE("an empty problem is solved at once") {
    const DenseOperator A(Eigen::MatrixXd(0, 0));
    const auto result = solve(A, Eigen::VectorXd(0), tight());
    CHECK(result.status == LcpStatus::converged);
    CHECK(result.iterations == 0);
}

TEST_CASE("one contact by hand: gamma = -b/A where b < 0, else 0") {
    const DenseOperator A(Eigen::MatrixXd::Constant(1, 1, 4.0));
    CHECK(solve(A, Eigen::VectorXd::Constant(1, -2.0), tight()).solution[0] == doctest::Approx(0.5));
    CHECK(solve(A, Eigen::VectorXd::Constant(1, 2.0), tight()).solution[0] == 0.0);
    CHECK(solve(A, Eigen::VectorXd::Constant(1, 0.0), tight()).solution[0] == 0.0);
}

TEST_CASE("three beads in a row by hand: pushing the outer ones inwards") {
    // Contacts 1-2 and 2-3, unit mobility: A = [2 -1; -1 2]. b = (-1, -1) gives gamma = (1, 1).
    Eigen::MatrixXd A(2, 2);
    A << 2, -1, -1, 2;
    const auto result = solve(DenseOperator(A), Eigen::VectorXd::Constant(2, -1.0), tight());
    CHECK(result.solution[0] == doctest::Approx(1.0).epsilon(1e-10));
    CHECK(result.solution[1] == doctest::Approx(1.0).epsilon(1e-10));
    // b = (-1, 2): the first contact alone, which opens the second by less than it may.
    Eigen::VectorXd b(2);
    b << -1, 2;
    const auto one = solve(DenseOperator(A), b, tight());
    CHECK(one.solution[0] == doctest::Approx(0.5).epsilon(1e-10));
    CHECK(one.solution[1] == 0.0);
}

TEST_CASE("random problems agree with enumeration of active sets, for every step rule") {
    const unsigned seed = 20190409;
    MESSAGE("seed ", seed);
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    for (const auto rule : {BarzilaiBorwein::bb1, BarzilaiBorwein::bb2, BarzilaiBorwein::alternating}) {
        for (int trial = 0; trial < 60; ++trial) {
            const Eigen::Index n = 1 + trial % 7;
            const Eigen::Index rank =
                trial % 3 == 0 ? std::max<Eigen::Index>(1, n - 1) : n + 2;  // every third is singular
            const auto draw = [&]() { return normal(engine); };
            const Eigen::MatrixXd D = Eigen::MatrixXd::NullaryExpr(rank, n, draw);
            // b = D^T u + a positive vector keeps singular problems feasible.
            const Eigen::VectorXd u = Eigen::VectorXd::NullaryExpr(rank, draw);
            Eigen::VectorXd b = D.transpose() * u;
            for (Eigen::Index l = 0; l < n; ++l) b(l) += std::fabs(draw()) * 0.3;
            const DenseOperator A(D.transpose() * D);
            const auto result = solve(A, b, tight(rule));
            REQUIRE(result.status == LcpStatus::converged);
            const Eigen::VectorXd expected = velocity_by_enumeration(A.matrix(), b);
            for (Eigen::Index l = 0; l < n; ++l) {
                CHECK(result.solution[static_cast<std::size_t>(l)] >= 0.0);
                CHECK(result.velocity[static_cast<std::size_t>(l)] ==
                      doctest::Approx(expected(l)).epsilon(1e-6).scale(1.0));
            }
        }
    }
}

TEST_CASE("a contact problem without a solution ends with a report") {
    // Two contacts press one body from both sides (A singular: gamma = (t, t) does nothing), and both want to open.
    Eigen::MatrixXd A(2, 2);
    A << 1, -1, -1, 1;
    LcpSettings settings = tight();
    settings.max_iterations = 500;
    const auto result = solve(DenseOperator(A), Eigen::VectorXd::Constant(2, -1.0), settings);
    CHECK(result.status == LcpStatus::infeasible);
    CHECK(result.residual >= 0.9);
    CHECK(result.iterations <= 500);
}

TEST_CASE("too few iterations are told apart from infeasibility") {
    const int n = 40;
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
    for (int l = 0; l < n; ++l) {
        A(l, l) = 2.0;
        if (l > 0) A(l, l - 1) = A(l - 1, l) = -1.0;
    }
    LcpSettings settings = tight();
    settings.max_iterations = 60;
    settings.tolerance = 1e-14;
    const auto result = solve(DenseOperator(A), Eigen::VectorXd::Constant(n, -1.0), settings);
    CHECK(result.status == LcpStatus::iteration_limit);
    CHECK(result.residual > 1e-14);
}

TEST_CASE("NaN and infinity are reported, not iterated on") {
    const DenseOperator A(Eigen::MatrixXd::Identity(2, 2));
    Eigen::VectorXd b(2);
    b << -1.0, std::nan("");
    CHECK(solve(A, b, tight()).status == LcpStatus::not_finite);
    b << -1.0, -INFINITY;
    CHECK(solve(A, b, tight()).status == LcpStatus::not_finite);
}

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

TEST_CASE("a start near the solution saves iterations and gives the same answer") {
    Eigen::MatrixXd A(2, 2);
    A << 2, -1, -1, 2;
    const DenseOperator matrix(A);
    const std::vector<double> b{-1.0, -1.0}, start{1.0, 1.0};
    const auto result = solve_bbpgd({matrix, b, 1.0}, tight(), start);
    CHECK(result.status == LcpStatus::converged);
    CHECK(result.iterations == 1);
}
