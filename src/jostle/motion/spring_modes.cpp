#include "jostle/motion/spring_modes.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "jostle/rods/rod_mobility.hpp"

namespace jostle {

namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::SparseMatrix<double>;
using Edge = std::pair<int, int>;

double strength(const Spring& spring, double kT, int dimensions) {
    const double link = spring.rest_length + std::fabs(spring.s_1) + std::fabs(spring.s_2);
    return 1.0 / (1.0 / spring.stiffness + (kT > 0.0 ? link * link / (dimensions * kT) : 0.0));
}

/// The first rod of the connected part that each rod is in.
std::vector<int> parts(int count, const std::vector<Edge>& edges) {
    std::vector<int> first(static_cast<std::size_t>(count));
    std::iota(first.begin(), first.end(), 0);
    const auto root = [&first](int i) {
        while (first[static_cast<std::size_t>(i)] != i) {
            int& next = first[static_cast<std::size_t>(i)];
            i = next = first[static_cast<std::size_t>(next)];
        }
        return i;
    };
    for (const auto& [i, j] : edges) {
        const std::pair<int, int> roots = std::minmax(root(i), root(j));
        first[static_cast<std::size_t>(roots.second)] = roots.first;
    }
    for (int i = 0; i < count; ++i) first[static_cast<std::size_t>(i)] = root(i);
    return first;
}

/// Rods that springs join, as the symmetric matrix M^1/2 K M^1/2, whose eigenvalues are the rates of M K.
struct Network {
    Vector root_mobility;   ///< M^1/2
    Matrix rates;           ///< M^1/2 K M^1/2
    std::vector<int> part;  ///< of each rod

    /// Takes out of `x` what moves no spring, the parts as wholes: M^-1/2 times a constant in each.
    void remove_translations(Vector& x) const {
        Vector along = Vector::Zero(x.size()), square = Vector::Zero(x.size());
        for (int i = 0; i < x.size(); ++i) {
            along(part[static_cast<std::size_t>(i)]) += x(i) / root_mobility(i);
            square(part[static_cast<std::size_t>(i)]) += 1.0 / (root_mobility(i) * root_mobility(i));
        }
        for (int i = 0; i < x.size(); ++i) {
            const int whole = part[static_cast<std::size_t>(i)];
            x(i) -= along(whole) / square(whole) / root_mobility(i);
        }
    }
};

Network network(std::span<const Spring> springs, const MobilityOfRod& mobility_of, double kT, int dimensions) {
    std::map<std::uint64_t, int> rows;
    for (const Spring& spring : springs)
        for (const std::uint64_t id : {spring.rod_1, spring.rod_2})
            if (spring.stiffness > 0.0) rows.emplace(id, 0);
    int count = 0;
    for (auto& [id, row] : rows) row = count++;
    Network made{Vector(count), Matrix(count, count), {}};
    for (const auto& [id, row] : rows)
        made.root_mobility(row) = std::sqrt(translational_diffusion(1.0, mobility_of(id), dimensions));
    std::vector<Edge> edges;
    std::vector<Eigen::Triplet<double>> elements;
    for (const Spring& spring : springs) {
        if (spring.stiffness == 0.0) continue;
        const int i = rows.at(spring.rod_1), j = rows.at(spring.rod_2);
        const double of_spring = strength(spring, kT, dimensions);
        const double u = made.root_mobility(i), v = made.root_mobility(j);
        edges.emplace_back(i, j);
        elements.emplace_back(i, i, u * u * of_spring);
        elements.emplace_back(j, j, v * v * of_spring);
        elements.emplace_back(i, j, -u * v * of_spring);
        elements.emplace_back(j, i, -u * v * of_spring);
    }
    made.rates.setFromTriplets(elements.begin(), elements.end());
    made.part = parts(count, edges);
    return made;
}

}  // namespace

double slowest_spring_time(std::span<const Spring> springs, const MobilityOfRod& mobility_of, double kT,
                           int dimensions) {
    // Inverse iteration among the vectors that stretch springs. The shift keeps the matrix invertible, and is far below
    // every rate.
    constexpr double shift = 1e-12, close = 1e-3;
    constexpr int most = 200;
    const Network rods = network(springs, mobility_of, kT, dimensions);
    const auto count = rods.rates.rows();
    if (count == 0) return 0.0;
    Matrix shifted = rods.rates;
    shifted.diagonal().array() += shift * rods.rates.diagonal().maxCoeff();
    const Eigen::SimplicialLDLT<Matrix> inverse(shifted);
    Vector mode(count);  // of no symmetry
    for (int i = 0; i < count; ++i) mode(i) = std::sin(1.0 + i + 0.1 * i * i);
    double rate = 0.0;
    for (int k = 0; k < most; ++k) {
        rods.remove_translations(mode);
        mode.normalize();
        const double before = std::exchange(rate, mode.dot(rods.rates * mode));
        if (k > 0 && before - rate <= close * rate) break;
        mode = inverse.solve(mode);
    }
    return 1.0 / rate;
}

}  // namespace jostle
