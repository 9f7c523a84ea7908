// What every solver of lcp must do. Each test runs all of them.

#include <doctest/doctest.h>

#include <random>
#include <string>

#include "dense_operator.hpp"
#include "lcp_solvers.hpp"
#include "sphere_network.hpp"

using namespace jostle;
using jostle::test::DenseOperator;
using jostle::test::for_each_solver;
using jostle::test::Solver;
using jostle::test::SphereNetwork;
using jostle::test::tight;

namespace {

LcpResult solve(const Solver& solver, const DenseOperator& A, const Eigen::VectorXd& b, const LcpSettings& settings,
                std::span<const double> start = {}) {
    return solver.solve({A, {b.data(), static_cast<std::size_t>(b.size())}, 1.0}, settings, start);
}

LcpResult solve(const Solver& solver, const DenseOperator& A, const Eigen::VectorXd& b) {
    return solve(solver, A, b, tight(solver));
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

struct DenseProblem {
    Eigen::MatrixXd A;
    Eigen::VectorXd b;
};

/// A = D^T D with D of rank x n normal numbers; b = D^T u + a positive vector, so that it can be solved for any rank.
DenseProblem random_problem(Eigen::Index rank, Eigen::Index n, std::mt19937_64& engine) {
    std::normal_distribution<double> normal;
    const auto draw = [&]() { return normal(engine); };
    const Eigen::MatrixXd D = Eigen::MatrixXd::NullaryExpr(rank, n, draw);
    const Eigen::VectorXd u = Eigen::VectorXd::NullaryExpr(rank, draw);
    Eigen::VectorXd b = D.transpose() * u;
    for (Eigen::Index l = 0; l < n; ++l) b(l) += std::fabs(draw()) * 0.3;
    return {D.transpose() * D, b};
}

/// A chain of n + 1 beads of unit mobility: the harder, the longer.
Eigen::MatrixXd chain(int n) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
    for (int l = 0; l < n; ++l) {
        A(l, l) = 2.0;
        if (l > 0) A(l, l - 1) = A(l - 1, l) = -1.0;
    }
    return A;
}

/// That the result is what it says: gamma >= 0, the velocity is A gamma + b, and the residual is theirs.
void check_consistent(const LcpProblem& problem, const LcpResult& result) {
    REQUIRE(result.solution.size() == problem.constant.size());
    std::vector<double> velocity(result.solution.size());
    problem.matrix.apply(result.solution, velocity);
    for (std::size_t l = 0; l < velocity.size(); ++l) {
        velocity[l] += problem.constant[l];
        CHECK(result.solution[l] >= 0.0);
        CHECK(result.velocity[l] == velocity[l]);
    }
    CHECK(result.residual == lcp_residual(problem, LcpResidual::length, result.solution, velocity));
}

}  // namespace

TEST_CASE("an empty problem is solved at once") {
    for_each_solver([](const Solver& solver) {
        const auto result = solve(solver, DenseOperator(Eigen::MatrixXd(0, 0)), Eigen::VectorXd(0));
        CHECK(result.status == LcpStatus::converged);
        CHECK(result.iterations == 0);
    });
}

TEST_CASE("a search that is interrupted ends at once and says so") {
    for_each_solver([](const Solver& solver) {
        const DenseOperator A(chain(60));
        const Eigen::VectorXd b = Eigen::VectorXd::Constant(60, -1.0);
        for (const int questions : {1, 2, 5}) {
            int asked = 0;
            LcpSettings settings = tight(solver);
            settings.interrupted = [&] { return ++asked == questions; };
            const LcpProblem problem{A, {b.data(), 60}, 1.0};
            const LcpResult result = solver.solve(problem, settings, {});
            CHECK(result.status == LcpStatus::interrupted);
            CHECK(asked == questions);
            CHECK(result.iterations == static_cast<std::uint64_t>(questions));
            check_consistent(problem, result);
        }
        LcpSettings settings = tight(solver);
        settings.interrupted = [] { return false; };
        CHECK(solver.solve({A, {b.data(), 60}, 1.0}, settings, {}).status == LcpStatus::converged);
    });
}

TEST_CASE("one contact by hand: gamma = -b/A where b < 0, else 0") {
    for_each_solver([](const Solver& solver) {
        const DenseOperator A(Eigen::MatrixXd::Constant(1, 1, 4.0));
        CHECK(solve(solver, A, Eigen::VectorXd::Constant(1, -2.0)).solution[0] == doctest::Approx(0.5));
        CHECK(solve(solver, A, Eigen::VectorXd::Constant(1, 2.0)).solution[0] == 0.0);
        CHECK(solve(solver, A, Eigen::VectorXd::Constant(1, 0.0)).solution[0] == 0.0);
    });
}

TEST_CASE("three beads in a row by hand: pushing the outer ones inwards") {
    for_each_solver([](const Solver& solver) {
        // Contacts 1-2 and 2-3, unit mobility: A = [2 -1; -1 2]. b = (-1, -1) gives gamma = (1, 1).
        const DenseOperator A(chain(2));
        const auto both = solve(solver, A, Eigen::VectorXd::Constant(2, -1.0));
        CHECK(both.solution[0] == doctest::Approx(1.0).epsilon(1e-10));
        CHECK(both.solution[1] == doctest::Approx(1.0).epsilon(1e-10));
        // b = (-1, 2): the first contact alone, which opens the second by less than it may.
        const auto one = solve(solver, A, Eigen::Vector2d(-1.0, 2.0));
        CHECK(one.solution[0] == doctest::Approx(0.5).epsilon(1e-10));
        CHECK(one.solution[1] == 0.0);
    });
}

TEST_CASE("random problems agree with enumeration of active sets; every third is singular") {
    const unsigned seed = 20190409;
    MESSAGE("seed ", seed);
    for_each_solver([&](const Solver& solver) {
        std::mt19937_64 engine(seed);
        for (int trial = 0; trial < 60; ++trial) {
            const Eigen::Index n = 1 + trial % 7;
            const auto [matrix, b] =
                random_problem(trial % 3 == 0 ? std::max<Eigen::Index>(1, n - 1) : n + 2, n, engine);
            const DenseOperator A(matrix);
            const auto result = solve(solver, A, b);
            REQUIRE(result.status == LcpStatus::converged);
            const Eigen::VectorXd expected = velocity_by_enumeration(matrix, b);
            for (Eigen::Index l = 0; l < n; ++l) {
                CHECK(result.solution[static_cast<std::size_t>(l)] >= 0.0);
                CHECK(result.velocity[static_cast<std::size_t>(l)] ==
                      doctest::Approx(expected(l)).epsilon(1e-6).scale(1.0));
            }
        }
    });
}

TEST_CASE("contacts that are dependent, or nearly so, do not stop the search") {
    // Each contact appears twice, the second time turned by a small angle: A has eigenvalues down to angle^2, or 0.
    const unsigned seed = 7;
    MESSAGE("seed ", seed);
    for (const double angle : {0.0, 1e-12, 1e-2}) {
        CAPTURE(angle);
        for_each_solver([&](const Solver& solver) {
            std::mt19937_64 engine(seed);
            std::normal_distribution<double> normal;
            const auto draw = [&]() { return normal(engine); };
            for (int trial = 0; trial < 10; ++trial) {
                Eigen::MatrixXd D(8, 10);
                D.leftCols(5) = Eigen::MatrixXd::NullaryExpr(8, 5, draw);
                D.rightCols(5) = D.leftCols(5) + angle * Eigen::MatrixXd::NullaryExpr(8, 5, draw);
                const Eigen::VectorXd u = Eigen::VectorXd::NullaryExpr(8, draw);
                const DenseOperator A(D.transpose() * D);
                const Eigen::VectorXd b = D.transpose() * u;
                LcpSettings settings = tight(solver);
                settings.tolerance = 1e-9;
                settings.max_iterations = 100000;
                const auto result = solve(solver, A, b, settings);
                CHECK(result.status == LcpStatus::converged);
                check_consistent({A, {b.data(), 10}}, result);
            }
        });
    }
}

TEST_CASE("a contact without mobility keeps the others' solution, and cannot be opened") {
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(3, 3);
    A.topLeftCorner(2, 2) = chain(2);
    for_each_solver([&](const Solver& solver) {
        const auto open = solve(solver, DenseOperator(A), Eigen::Vector3d(-1.0, -1.0, 0.5));
        CHECK(open.status == LcpStatus::converged);
        CHECK(open.solution[0] == doctest::Approx(1.0).epsilon(1e-10));
        LcpSettings settings = tight(solver);
        settings.max_iterations = 200;
        const auto closed = solve(solver, DenseOperator(A), Eigen::Vector3d(-1.0, -1.0, -0.5), settings);
        CHECK(closed.status != LcpStatus::converged);
        CHECK(closed.status != LcpStatus::not_finite);
        CHECK(closed.residual >= 0.5);
    });
}

TEST_CASE("a contact problem without a solution ends with a report") {
    // Two contacts press one body from both sides (A singular: gamma = (t, t) does nothing), and both want to open.
    Eigen::MatrixXd A(2, 2);
    A << 1, -1, -1, 1;
    for_each_solver([&](const Solver& solver) {
        LcpSettings settings = tight(solver);
        settings.max_iterations = 500;
        for (const double second : {-1.0, -0.3}) {
            const auto result = solve(solver, DenseOperator(A), Eigen::Vector2d(-1.0, second), settings);
            CHECK(result.status == LcpStatus::infeasible);
            CHECK(result.residual >= -0.5 * (second - 1.0) - 1e-12);  // half the sum: it can only be shared
            CHECK(result.iterations <= 500);
        }
    });
}

TEST_CASE("too few iterations are told apart from infeasibility, and the best iterate is returned") {
    const unsigned seed = 3;
    MESSAGE("seed ", seed);
    std::mt19937_64 engine(seed);
    const auto [matrix, constant] = random_problem(45, 40, engine);
    const DenseOperator A(matrix);
    const std::vector<double> b(constant.begin(), constant.end());
    for_each_solver([&](const Solver& solver) {
        LcpSettings settings = tight(solver);
        settings.tolerance = 1e-14;
        const double at_zero = lcp_residual({A, b}, LcpResidual::length, std::vector<double>(b.size()), b);
        for (const std::uint64_t limit : {0, 1, 2, 5, 15, 30}) {
            settings.max_iterations = limit;
            const auto result = solver.solve({A, b}, settings, {});
            CHECK(result.iterations <= limit);
            if (limit >= 5) CHECK(result.status == LcpStatus::iteration_limit);
            CHECK(result.residual > 1e-14);
            CHECK(result.residual <= at_zero);
            check_consistent({A, b}, result);
        }
    });
}

TEST_CASE("NaN and infinity are reported, not iterated on") {
    const DenseOperator A(Eigen::MatrixXd::Identity(2, 2));
    const DenseOperator broken(Eigen::MatrixXd::Constant(2, 2, NAN));
    for_each_solver([&](const Solver& solver) {
        for (const double b : {NAN, -INFINITY}) {
            const auto result = solve(solver, A, Eigen::Vector2d(-1.0, b));
            CHECK(result.status == LcpStatus::not_finite);
            CHECK(result.iterations == 0);
        }
        const auto result = solve(solver, broken, Eigen::Vector2d(-1.0, -1.0));
        CHECK(result.status == LcpStatus::not_finite);
        CHECK(result.iterations == 0);
    });
}

TEST_CASE("a start at the solution costs one application, one near it saves a gradient method some") {
    const DenseOperator A(chain(20));
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(20, -1.0, -3.0);
    const Eigen::VectorXd exact = chain(20).llt().solve(-b);
    for_each_solver([&](const Solver& solver) {
        LcpSettings settings = tight(solver);
        settings.tolerance = 1e-9;
        const auto cold = solve(solver, A, b, settings);
        std::vector<double> start(exact.data(), exact.data() + 20);
        const auto solved = solve(solver, A, b, settings, start);
        CHECK(solved.status == LcpStatus::converged);
        CHECK(solved.iterations == 1);
        CHECK(solved.solution == start);
        for (double& force : start) force *= 1.0 + 1e-7;
        const auto warm = solve(solver, A, b, settings, start);
        CHECK(warm.status == LcpStatus::converged);
        // Newton's conjugate gradients need about as many as there are contacts, from wherever they start.
        if (solver.name != std::string("minimum_map_newton")) CHECK(warm.iterations < cold.iterations);
        for (std::size_t l = 0; l < 20; ++l) CHECK(warm.velocity[l] == doctest::Approx(cold.velocity[l]).scale(1.0));
    });
}

TEST_CASE("networks of spheres: all solvers agree; applications of A are told") {
    const unsigned seed = 11;
    for (const double jitter : jostle::test::jitters) {
        const SphereNetwork network(8, jitter, seed);
        const LcpProblem problem{network, network.constant()};
        std::vector<double> first;
        std::string counts;
        for_each_solver([&](const Solver& solver) {
            LcpSettings settings = tight(solver);
            settings.tolerance = 1e-6;
            counts += std::string(solver.name) + " " + std::to_string(solver.solve(problem, settings, {}).iterations);
            settings.tolerance = 1e-9;
            const auto result = solver.solve(problem, settings, {});
            counts += " " + std::to_string(result.iterations) + ", ";
            REQUIRE(result.status == LcpStatus::converged);
            check_consistent(problem, result);
            if (first.empty()) first = result.velocity;
            for (std::size_t l = 0; l < first.size(); ++l)
                CHECK(result.velocity[l] == doctest::Approx(first[l]).epsilon(1e-6).scale(1.0));
        });
        MESSAGE("seed ", seed, ", ", network.size(), " contacts, to 1e-6 and 1e-9: ", counts);
    }
}
