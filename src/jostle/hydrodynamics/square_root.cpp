#include "jostle/hydrodynamics/square_root.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

constexpr std::size_t max_applications = 100;

double inner_product(std::span<const LineVector> a, std::span<const LineVector> b) {
    return parallel_sum<double>(
        a.size(), [&](std::size_t i) { return dot(a[i].centre, b[i].centre) + dot(a[i].moment, b[i].moment); });
}

/// a += factor b
void add_multiple(std::span<LineVector> a, double factor, std::span<const LineVector> b) {
    parallel_for(a.size(), [&](std::size_t i) {
        a[i].centre += factor * b[i].centre;
        a[i].moment += factor * b[i].moment;
    });
}

std::vector<LineVector> multiple(double factor, std::span<const LineVector> a) {
    std::vector<LineVector> result(a.size());
    add_multiple(result, factor, a);
    return result;
}

/// The first column of the square root of a symmetric tridiagonal matrix.
Eigen::VectorXd first_column_of_root(const std::vector<double>& diagonal, const std::vector<double>& beside) {
    const auto size = static_cast<Eigen::Index>(diagonal.size());
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
    solver.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal.data(), size),
                                  Eigen::Map<const Eigen::VectorXd>(beside.data(), size - 1));
    const Eigen::VectorXd roots = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
    return solver.eigenvectors() * roots.cwiseProduct(solver.eigenvectors().row(0).transpose());
}

/// Whether the last application changed the combination of the basis by less than a part of it.
bool has_settled(const Eigen::VectorXd& now, const Eigen::VectorXd& before, double relative_change) {
    if (before.size() == 0) return false;
    const Eigen::Index known = before.size();
    const double change = std::hypot((now.head(known) - before).norm(), now.tail(now.size() - known).norm());
    return change <= relative_change * now.norm();
}

}  // namespace

std::vector<LineVector> times_square_root(const LineOperator& matrix, std::vector<LineVector> x,
                                          double relative_change) {
    const double size = std::sqrt(inner_product(x, x));
    if (size == 0.0) return x;
    std::vector<std::vector<LineVector>> basis = {multiple(1.0 / size, x)};
    std::vector<double> diagonal, beside;
    Eigen::VectorXd combination, before;
    for (;;) {
        std::vector<LineVector> next(x.size());
        matrix(basis.back(), next);
        if (basis.size() > 1) add_multiple(next, -beside.back(), basis[basis.size() - 2]);
        diagonal.push_back(inner_product(next, basis.back()));
        add_multiple(next, -diagonal.back(), basis.back());
        combination = first_column_of_root(diagonal, beside);
        const double rest = std::sqrt(inner_product(next, next));
        const bool complete = !(rest > 1e-12 * diagonal.front());
        if (complete || has_settled(combination, before, relative_change) || basis.size() == max_applications) break;
        before = combination;
        beside.push_back(rest);
        basis.push_back(multiple(1.0 / rest, next));
    }
    std::vector<LineVector> result(x.size());
    for (std::size_t k = 0; k < basis.size(); ++k)
        add_multiple(result, size * combination(static_cast<Eigen::Index>(k)), basis[k]);
    return result;
}

}  // namespace jostle
