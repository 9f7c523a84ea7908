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

using Apply = std::function<void(const Rods&, const Forces&, Velocities&)>;

/// B, by the interface that adds B xi to velocities.
Apply square_root_of(const DragMobility& mobility) {
    return [&mobility](const Rods& rods, const Forces& xi, Velocities& velocities) {
        std::vector<Normals> normals(rods.size());
        for (std::size_t i = 0; i < rods.size(); ++i)
            normals[i] = {xi.force[i].x, xi.force[i].y, xi.force[i].z, xi.torque[i].x, xi.torque[i].y, xi.torque[i].z};
        velocities = Velocities(rods.size());
        mobility.add_square_root(rods, 0, normals, 0.25, velocities);
        const std::size_t half = rods.size() / 2;  // it adds, and takes parts
        mobility.add_square_root(rods, 0, {normals.data(), half}, 0.75, velocities);
        mobility.add_square_root(rods, half, {normals.data() + half, rods.size() - half}, 0.75, velocities);
    };
}

/// The 6N x 6N matrix of a linear map, column by column from unit vectors.
Eigen::MatrixXd matrix_of(const Rods& rods, const Apply& apply) {
    const auto size = static_cast<Eigen::Index>(6 * rods.size());
    Eigen::MatrixXd matrix(size, size);
    for (Eigen::Index column = 0; column < size; ++column) {
        Forces unit(rods.size());
        const auto rod = static_cast<std::size_t>(column / 6);
        const int k = static_cast<int>(column % 6);
        (k < 3 ? unit.force[rod][k] : unit.torque[rod][k - 3]) = 1.0;
        Velocities answer;
        apply(rods, unit, answer);
        REQUIRE(answer.size() == rods.size());
        for (Eigen::Index row = 0; row < size; ++row) {
            const auto moved = static_cast<std::size_t>(row / 6);
            const int m = static_cast<int>(row % 6);
            matrix(row, column) = m < 3 ? answer.linear[moved][m] : answer.angular[moved][m - 3];
        }
    }
    return matrix;
}

}  // namespace

TEST_CASE("a rod along z moves and turns by its three coefficients; spin about the axis gives nothing") {
    Rods rods;
    rods.push_back(0, {0, 0, 0}, {0, 0, 1}, 5.0, 1.0);
    DragMobility mobility(drag_law);
    mobility.update(rods);
    Forces forces(1);
    forces.force[0] = {1, 2, 3};
    forces.torque[0] = {4, 5, 6};
    Velocities velocities;
    mobility.apply(rods, forces, velocities);
    const RodMobility own = drag_law(5.0, 1.0);
    CHECK(mobility.of_rod(0).parallel == own.parallel);
    CHECK(norm(velocities.linear[0] - Vec3{own.perpendicular, 2 * own.perpendicular, 3 * own.parallel}) < 1e-15);
    CHECK(norm(velocities.angular[0] - Vec3{4 * own.rotational, 5 * own.rotational, 0}) < 1e-15);
}

TEST_CASE("M is symmetric, positive on all but the spins, and B B^T = M") {
    MESSAGE("seed " << seed);
    const Rods rods = random_rods(6);
    DragMobility mobility(drag_law);
    mobility.update(rods);
    const Apply apply = [&](const Rods& all, const Forces& forces, Velocities& velocities) {
        mobility.apply(all, forces, velocities);
    };
    const Eigen::MatrixXd m = matrix_of(rods, apply);
    const Eigen::MatrixXd b = matrix_of(rods, square_root_of(mobility));
    const double scale = m.cwiseAbs().maxCoeff();
    CHECK((m - m.transpose()).cwiseAbs().maxCoeff() <= 1e-15 * scale);
    CHECK((b * b.transpose() - m).cwiseAbs().maxCoeff() <= 4e-15 * scale);

    const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m).eigenvalues();
    const auto spins = static_cast<Eigen::Index>(rods.size());
    CHECK(eigenvalues.head(spins).cwiseAbs().maxCoeff() <= 1e-14 * scale);
    double smallest = scale;
    for (std::size_t i = 0; i < rods.size(); ++i) {
        const RodMobility own = mobility.of_rod(i);
        smallest = std::min({smallest, own.perpendicular, own.parallel, own.rotational});
        Eigen::VectorXd spin = Eigen::VectorXd::Zero(m.rows());
        for (int k = 0; k < 3; ++k) spin(static_cast<Eigen::Index>(6 * i) + 3 + k) = rods.axis[i][k];
        CHECK((m * spin).cwiseAbs().maxCoeff() <= 1e-15 * scale);
    }
    CHECK(eigenvalues(spins) == doctest::Approx(smallest).epsilon(1e-10));
}

TEST_CASE("update takes over changed lengths, and asks the law once for equal neighbours") {
    Rods rods;
    for (std::uint64_t i = 0; i < 4; ++i) rods.push_back(i, {0, 0, 0}, {1, 0, 0}, 2.0, 1.0);
    rods.length[3] = 3.0;
    int calls = 0;
    DragMobility mobility([&calls](double length, double diameter) {
        ++calls;
        return drag_law(length, diameter);
    });
    mobility.update(rods);
    CHECK(calls == 2);
    CHECK(mobility.of_rod(2).rotational == drag_law(2.0, 1.0).rotational);
    CHECK(mobility.of_rod(3).rotational == drag_law(3.0, 1.0).rotational);
    rods.length[3] = 4.0;
    rods.push_back(9, {0, 0, 0}, {1, 0, 0}, 0.0, 2.0);
    mobility.update(rods);
    CHECK(mobility.of_rod(3).parallel == drag_law(4.0, 1.0).parallel);
    CHECK(mobility.of_rod(4).parallel == drag_law(0.0, 2.0).parallel);
}

TEST_CASE("the same bits for any number of threads") {
    const Rods rods = random_rods(3000);
    DragMobility mobility(drag_law);
    mobility.update(rods);
    Forces forces(rods.size());
    for (std::size_t i = 0; i < rods.size(); ++i) {
        forces.force[i] = rods.axis[(i + 1) % rods.size()];
        forces.torque[i] = rods.axis[(i + 2) % rods.size()];
    }
    const int threads_before = parallel::thread_count();
    Velocities one, three;
    parallel::set_thread_count(1);
    square_root_of(mobility)(rods, forces, one);
    parallel::set_thread_count(3);
    square_root_of(mobility)(rods, forces, three);
    parallel::set_thread_count(threads_before);
    CHECK(one.linear == three.linear);
    CHECK(one.angular == three.angular);
}
