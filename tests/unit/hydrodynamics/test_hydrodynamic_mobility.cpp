#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <numbers>

#include "jostle/error/input_error.hpp"
#include "jostle/hydrodynamics/hydrodynamic_mobility.hpp"
#include "jostle/math/rotation.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/rods/space_filling_order.hpp"
#include "random_rods.hpp"

using namespace jostle;

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::uint64_t seed = 20261123;

const Box open{{20, 20, 20}, {false, false, false}};

}  // namespace

// Hasimoto, J. Fluid Mech. 5, 317 (1959); the term of x^3 is exact for M.
TEST_CASE("a sphere in a cubic box of edge B: 3 pi mu D M = 1 - 2.83729748 x + (4 pi/3) x^3, x = D/2B") {
    for (const double edge : {5.0, 10.0, 20.0}) {
        Rods rods;
        rods.push_back(0, {1.1, 2.3, 0.7}, {1, 0, 0}, 0.0, 1.0);
        Forces forces(1);
        forces.force[0] = {1.0, 0.3, -2.0};
        const double x = 0.5 / edge;
        const double expected = 1.0 - 2.8372974795 * x + 4.0 * pi / 3.0 * x * x * x;
        for (const auto& [tolerance, allowed] : {std::pair(1e-6, 1e-6), std::pair(1e-3, 3e-3)}) {
            const Velocities u = moved(HydrodynamicMobility(0.7, tolerance), rods, Box{{edge, edge, edge}}, forces);
            const double found = 3.0 * pi * 0.7 * dot(u.linear[0], forces.force[0]) / squared_norm(forces.force[0]);
            CHECK(std::fabs(found - expected) < allowed);
        }
    }
}

TEST_CASE("where a periodic sum is split does not matter, and its error is within the tolerance") {
    Chance chance(seed);
    const Box box{{14, 15, 16}};
    for (const double length : {0.0, 5.0}) {
        const Rods rods = chance.rods(12, length, box.edges());
        const Forces forces = chance.forces(rods);
        const Velocities exact = moved(HydrodynamicMobility(1.0, 1e-6, 5.0), rods, box, forces);
        for (const double tolerance : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2})
            for (const double cutoff : {2.0, 3.0, 4.0}) {
                CAPTURE(length);
                CAPTURE(tolerance);
                CAPTURE(cutoff);
                const auto [linear, angular] =
                    errors(moved(HydrodynamicMobility(1.0, tolerance, cutoff), rods, box, forces), exact);
                CHECK(linear < tolerance);
                CHECK(angular < 2.0 * tolerance);
            }
    }
}

// Flows are floats.
TEST_CASE("M is symmetric to rounding, and positive, for rods that overlap") {
    Chance chance(seed);
    for (const bool periodic : {true, false}) {
        const double rounding = std::numeric_limits<float>::epsilon();
        const Box box{{9, 10, 11}, {periodic, periodic, periodic}};
        const Rods rods = chance.rods(10, 5.0, box.edges());
        const HydrodynamicMobility model(1.0);
        const auto mobility = model.at(rods, box);
        const Forces a = chance.forces(rods), b = chance.forces(rods);
        Velocities by_a, by_b;
        mobility->apply(a, by_a);
        mobility->apply(b, by_b);
        CHECK(std::fabs(power(by_a, b) - power(by_b, a)) < rounding * (power(by_a, a) + power(by_b, b)));

        Eigen::MatrixXd matrix(60, 60);
        for (int column = 0; column < 60; ++column) {
            Forces unit(10);
            const auto rod = static_cast<std::size_t>(column / 6);
            (column % 6 < 3 ? unit.force : unit.torque)[rod][column % 3] = 1.0;
            Velocities u;
            mobility->apply(unit, u);
            for (int row = 0; row < 60; ++row)
                matrix(row, column) = (row % 6 < 3 ? u.linear : u.angular)[static_cast<std::size_t>(row / 6)][row % 3];
        }
        const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues();
        CHECK(eigenvalues(0) > -rounding * eigenvalues(59));  // spins about the axes: 10 times 0
        CHECK(eigenvalues(9) < rounding * eigenvalues(59));
        CHECK(eigenvalues(10) > 1e-3);
    }
}

TEST_CASE("a box that grows becomes an unbounded fluid, as 1/edge") {
    Chance chance(seed);
    Rods rods = chance.rods(4, 3.0, {5, 5, 5});
    Forces forces = chance.forces(rods);
    forces.force[3] = -(forces.force[0] + forces.force[1] + forces.force[2]);  // without it: as 1/edge; with it faster
    const Velocities exact = moved(HydrodynamicMobility(1.0), rods, open, forces);
    std::array<double, 2> before{1.0, 1.0};
    for (const double edge : {20.0, 40.0, 80.0}) {
        const auto now = errors(moved(HydrodynamicMobility(1.0, 1e-6), rods, Box{{edge, edge, edge}}, forces), exact);
        CAPTURE(edge);
        CHECK(now[0] < 0.35 * before[0]);
        before = now;
    }
    CHECK(before[0] < 1e-3);
}

// A_ll = D^T M D of a contact.
TEST_CASE("relative mobility of two points is what equal and opposite forces there open them by") {
    Chance chance(seed);
    const HydrodynamicMobility model(0.7);
    for (const double length : {0.0, 5.0})
        for (int trial = 0; trial < 20; ++trial) {
            const Rods rods = chance.rods(2, length, {4, 4, 4});
            const auto mobility = model.at(rods, open);
            PairOfPoints points{0, 1, length * (chance.uniform() - 0.5), length * (chance.uniform() - 0.5), {}, 0.0};
            const Vec3 between =
                rods.centre[1] + points.arm_j * rods.axis[1] - rods.centre[0] - points.arm_i * rods.axis[0];
            points.distance = norm(between);
            points.normal = between / points.distance;
            Forces forces(2);
            forces.force = {-points.normal, points.normal};
            forces.torque = {cross(points.arm_i * rods.axis[0], -points.normal),
                             cross(points.arm_j * rods.axis[1], points.normal)};
            Velocities u;
            mobility->apply(forces, u);
            CHECK(mobility->relative_mobility(points) == doctest::Approx(power(u, forces)).epsilon(1e-6));
        }
    // Touching spheres: 0.3718 of what they would have alone (1 - 1.5 D/2r + (D/2r)^3 = 0.375 of Rotne and Prager).
    Rods spheres;
    spheres.push_back(0, {0, 0, 0}, {0, 0, 1}, 0.0, 1.0);
    spheres.push_back(1, {1, 0, 0}, {0, 0, 1}, 0.0, 1.0);
    const double relative = model.at(spheres, open)->relative_mobility({0, 1, 0.0, 0.0, {1, 0, 0}, 1.0});
    CHECK(relative * 3.0 * pi * 0.7 / 2.0 == doctest::Approx(0.3718).epsilon(2e-4));
}

// Theory, eq. (7.8), with kT = 1: sum over rods j of the derivative of column T_j of M by a turn of j about the same
// axis. In the box the rod's own images are left out, which change angular velocities by 1 % here.
TEST_CASE("the thermal drift is div M: against central differences over all turns of all rods") {
    Chance chance(seed);
    for (const bool periodic : {false, true}) {
        const Box box{{30, 30, 30}, {periodic, periodic, periodic}};
        const Rods rods = chance.rods(3, 5.0, {6, 6, 6});
        const HydrodynamicMobility model(1.0, 1e-6, periodic ? std::optional(6.0) : std::nullopt);
        Velocities drift(3), difference(3);
        model.at(rods, box)->add_axial_flow({.kT = 1.0, .dipole = {}}, drift);
        constexpr double angle = 1e-2;  // the rounding of floats, 1e-7, over this and its square are far below 1e-3
        for (std::size_t j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k)
                for (const double sign : {-1.0, 1.0}) {
                    Vec3 turn{};
                    turn[k] = 1.0;
                    Rods turned = rods;
                    turned.axis[j] = rotated(rods.axis[j], sign * angle * turn);
                    Forces torque(3);
                    torque.torque[j] = turn;
                    const Velocities u = moved(model, turned, box, torque);
                    for (std::size_t i = 0; i < 3; ++i) {
                        difference.linear[i] += (0.5 * sign / angle) * u.linear[i];
                        difference.angular[i] += (0.5 * sign / angle) * u.angular[i];
                    }
                }
        const auto [linear, angular] = errors(drift, difference);
        MESSAGE("relative differences: ", linear, " of velocities, ", angular, " of angular velocities");
        CHECK(linear < 1e-3);
        CHECK(angular < (periodic ? 2e-2 : 1e-3));
    }
}

// <(y.U)^2> = y.M y for any y. 24 vectors of forces, each known to a standard error of 2.8 %; the
// mean of the squares of their deviations, in standard errors, is 1 +- sqrt(2/24): 5 of these are a false alarm in 1e5,
// as the vectors are not quite independent.
TEST_CASE("noise has the covariance M") {
    Chance chance(seed);
    constexpr int vectors = 24, samples = 2500;
    for (const bool periodic : {false, true}) {
        const Box box{{9, 10, 11}, {periodic, periodic, periodic}};
        const Rods rods = chance.rods(16, 3.0, box.edges());
        const HydrodynamicMobility model(1.0);
        const auto mobility = model.at(rods, box);
        std::vector<Forces> forces;
        for (int k = 0; k < vectors; ++k) forces.push_back(chance.forces(rods));
        const auto [chi_squared, mean] = deviation_of_noise(*mobility, forces, samples, seed);
        MESSAGE("chi squared by degree of freedom ", chi_squared, ", mean deviation ", mean, " standard errors");
        CHECK(std::fabs(chi_squared - 1.0) < 5.0 * std::sqrt(2.0 / vectors));
        CHECK(std::fabs(mean) < 5.0 / std::sqrt(vectors));
    }
}

TEST_CASE("flow, noise and drift have the same bits for any number of threads and any order of rows") {
    Chance chance(seed);
    for (const bool periodic : {true, false}) {
        const Box box{{22, 20, 18}, {periodic, periodic, periodic}};
        const Rods rods = chance.rods(600, 2.0, box.edges());
        const Forces forces = chance.forces(rods);
        const auto all_of = [&](const Rods& these, const Forces& pushed, int threads) {
            parallel::set_thread_count(threads);
            const HydrodynamicMobility model(1.0);
            const auto mobility = model.at(these, box);
            Velocities u;
            mobility->apply(pushed, u);
            mobility->add_square_root({seed, 3, Stream::brownian, 0}, 1.5, u);
            mobility->add_axial_flow({.kT = 0.8, .dipole = {}}, u);
            return u;
        };
        CHECK(has_same_bits_always(rods, forces, all_of));
    }
    parallel::set_thread_count(1);
}

TEST_CASE("boxes in which flows are not known are refused") {
    const auto refused = [](const Rods& rods, const Box& box) -> std::string {
        try {
            HydrodynamicMobility(1.0).at(rods, box);
        } catch (const InputError& error) {
            return error.parts().key;
        }
        return "";
    };
    Chance chance(seed);
    const Rods few = chance.rods(3, 1.0, {9, 9, 9}), many = chance.rods(max_rods_in_open_box + 1, 0.0, {99, 99, 99});
    CHECK(refused(few, {{9, 9, 9}, {true, true, false}}) == "box.periodic");
    CHECK(refused(few, {{9, 9, 9}, {false, false, false}}) == "");
    CHECK(refused(many, {{99, 99, 99}, {false, false, false}}) == "rods.count");
    CHECK(refused(many, {{99, 99, 99}, {true, true, true}}) == "");
}
