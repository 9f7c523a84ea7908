#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <functional>
#include <random>
#include <vector>

#include "jostle/mobility/drag.hpp"
#include "jostle/mobility/drag_mobility.hpp"
#include "jostle/parallel/parallel_for.hpp"

using namespace jostle;

namespace {

constexpr std::uint64_t seed = 7;
const Box box;

Rods random_rods(std::size_t count) {
    std::mt19937_64 generator(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform;
    Rods rods;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 axis = normalised(Vec3{normal(generator), normal(generator), normal(generator)});
        rods.push_back(i, {0, 0, 0}, axis, i % 3 == 0 ? 0.0 : 6.0 * uniform(generator), 0.5 + uniform(generator));
    }
    return rods;
}

RodMobility drag_law(double length, double diameter) {
    return finite_aspect_ratio_drag(length, diameter, 0.8);
}

constexpr RandomKey key{7, 3, Stream::test, 0};
using Apply = std::function<void(const Forces&, Velocities&)>;

/// The 6N x 6N matrix of a linear map, column by column from unit vectors.
Eigen::MatrixXd matrix_of(std::size_t count, const Apply& apply) {
    const auto size = static_cast<Eigen::Index>(6 * count);
    Eigen::MatrixXd matrix(size, size);
    for (Eigen::Index column = 0; column < size; ++column) {
        Forces unit(count);
        const auto rod = static_cast<std::size_t>(column / 6);
        const int k = static_cast<int>(column % 6);
        (k < 3 ? unit.force[rod][k] : unit.torque[rod][k - 3]) = 1.0;
        Velocities answer;
        apply(unit, answer);
        REQUIRE(answer.size() == count);
        for (Eigen::Index row = 0; row < size; ++row) {
            const auto moved = static_cast<std::size_t>(row / 6);
            const int m = static_cast<int>(row % 6);
            matrix(row, column) = m < 3 ? answer.linear[moved][m] : answer.angular[moved][m - 3];
        }
    }
    return matrix;
}

/// xi of every rod, as the square root has them.
Eigen::VectorXd noise_of(const Rods& rods) {
    std::vector<Normals> normals(rods.size());
    fill_normals(key, rods.id, normals);
    return Eigen::Map<Eigen::VectorXd>(normals[0].data(), static_cast<Eigen::Index>(6 * rods.size()));
}

Eigen::VectorXd vector_of(const Velocities& velocities) {
    Eigen::VectorXd all(static_cast<Eigen::Index>(6 * velocities.size()));
    for (std::size_t i = 0; i < velocities.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            all(static_cast<Eigen::Index>(6 * i) + k) = velocities.linear[i][k];
            all(static_cast<Eigen::Index>(6 * i) + 3 + k) = velocities.angular[i][k];
        }
    return all;
}

/// The symmetric root of a symmetric matrix without negative eigenvalues but by rounding.
Eigen::MatrixXd root_of(const Eigen::MatrixXd& m) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(m);
    const Eigen::VectorXd roots = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
    return solver.eigenvectors() * roots.asDiagonal() * solver.eigenvectors().transpose();
}

}  // namespace

TEST_CASE("a rod along z moves and turns by its three coefficients; spin about the axis gives nothing") {
    Rods rods;
    rods.push_back(0, {0, 0, 0}, {0, 0, 1}, 5.0, 1.0);
    const DragMobility model(drag_law);
    const auto mobility = model.at(rods, box);
    Forces forces(1);
    forces.force[0] = {1, 2, 3};
    forces.torque[0] = {4, 5, 6};
    Velocities velocities;
    mobility->apply(forces, velocities);
    const RodMobility own = drag_law(5.0, 1.0);
    CHECK(mobility->of_rod(0).parallel == own.parallel);
    CHECK(norm(velocities.linear[0] - Vec3{own.perpendicular, 2 * own.perpendicular, 3 * own.parallel}) < 1e-15);
    CHECK(norm(velocities.angular[0] - Vec3{4 * own.rotational, 5 * own.rotational, 0}) < 1e-15);
}

TEST_CASE("M is symmetric, positive on all but the spins, and B is its root; there is no drift") {
    MESSAGE("seed " << seed);
    const Rods rods = random_rods(6);
    const DragMobility model(drag_law);
    const auto mobility = model.at(rods, box);
    const Eigen::MatrixXd m = matrix_of(
        rods.size(), [&](const Forces& forces, Velocities& velocities) { mobility->apply(forces, velocities); });
    const double scale = m.cwiseAbs().maxCoeff();
    CHECK((m - m.transpose()).cwiseAbs().maxCoeff() <= 1e-15 * scale);
    Velocities noisy(rods.size());
    mobility->add_square_root(key, 0.25, noisy);
    mobility->add_square_root(key, 0.75, noisy);  // it adds
    // The root of every block is its symmetric one.
    CHECK((vector_of(noisy) - root_of(m) * noise_of(rods)).cwiseAbs().maxCoeff() <= 1e-7 * std::sqrt(scale));
    Velocities drifting(rods.size());
    mobility->add_axial_flow({.kT = 3.0, .dipole = {1.0, 2.0}}, drifting);
    CHECK(vector_of(drifting).cwiseAbs().maxCoeff() == 0.0);

    const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m).eigenvalues();
    const auto spins = static_cast<Eigen::Index>(rods.size());
    CHECK(eigenvalues.head(spins).cwiseAbs().maxCoeff() <= 1e-14 * scale);
    double smallest = scale;
    for (std::size_t i = 0; i < rods.size(); ++i) {
        const RodMobility own = mobility->of_rod(i);
        smallest = std::min({smallest, own.perpendicular, own.parallel, own.rotational});
        Eigen::VectorXd spin = Eigen::VectorXd::Zero(m.rows());
        for (int k = 0; k < 3; ++k) spin(static_cast<Eigen::Index>(6 * i) + 3 + k) = rods.axis[i][k];
        CHECK((m * spin).cwiseAbs().maxCoeff() <= 1e-15 * scale);
    }
    CHECK(eigenvalues(spins) == doctest::Approx(smallest).epsilon(1e-10));
}

TEST_CASE(
    "changed lengths are taken over; the law is asked once for equal neighbours, and not again for the same rods") {
    Rods rods;
    for (std::uint64_t i = 0; i < 4; ++i) rods.push_back(i, {0, 0, 0}, {1, 0, 0}, 2.0, 1.0);
    rods.length[3] = 3.0;
    int calls = 0;
    const DragMobility model([&calls](double length, double diameter) {
        ++calls;
        return drag_law(length, diameter);
    });
    CHECK(model.at(rods, box)->of_rod(2).rotational == drag_law(2.0, 1.0).rotational);
    CHECK(calls == 2);
    CHECK(model.at(rods, box)->of_rod(3).rotational == drag_law(3.0, 1.0).rotational);
    CHECK(calls == 2);
    const Rods before = rods;
    const auto of_before = model.at(before, box);
    rods.length[3] = 4.0;
    rods.push_back(9, {0, 0, 0}, {1, 0, 0}, 0.0, 2.0);
    const auto mobility = model.at(rods, box);
    CHECK(mobility->of_rod(3).parallel == drag_law(4.0, 1.0).parallel);
    CHECK(mobility->of_rod(4).parallel == drag_law(0.0, 2.0).parallel);
    CHECK(of_before->of_rod(3).parallel == drag_law(3.0, 1.0).parallel);
}

TEST_CASE("two points move apart by the mobility of both rods along the normal") {
    MESSAGE("seed " << seed);
    const Rods rods = random_rods(2);
    const DragMobility model(drag_law);
    const auto mobility = model.at(rods, box);
    const Vec3 normal = normalised(Vec3{1, -2, 0.5});
    const double arm_i = 0.7, arm_j = -0.4;
    Forces apart(2);
    apart.force = {-normal, normal};
    apart.torque = {cross(arm_i * rods.axis[0], -normal), cross(arm_j * rods.axis[1], normal)};
    Velocities velocities;
    mobility->apply(apart, velocities);
    const auto of_point = [&](std::size_t i, double arm) {
        return velocities.linear[i] + cross(velocities.angular[i], arm * rods.axis[i]);
    };
    CHECK(mobility->relative_mobility({0, 1, arm_i, arm_j, normal, 1.0}) ==
          doctest::Approx(dot(normal, of_point(1, arm_j) - of_point(0, arm_i))).epsilon(1e-13));
}

TEST_CASE("the same bits for any number of threads") {
    const Rods rods = random_rods(3000);
    const DragMobility model(drag_law);
    const int threads_before = parallel::thread_count();
    const auto noise = [&](int threads) {
        parallel::set_thread_count(threads);
        Velocities velocities(rods.size());
        model.at(rods, box)->add_square_root(key, 1.0, velocities);
        return velocities;
    };
    const Velocities one = noise(1), three = noise(3);
    parallel::set_thread_count(threads_before);
    CHECK(one.linear == three.linear);
    CHECK(one.angular == three.angular);
}
