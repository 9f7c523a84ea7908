// Spheres that turn with the fluid, and stir it by turning (theory, section 7.8).

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "jostle/hydrodynamics/couple_flow.hpp"
#include "jostle/hydrodynamics/hydrodynamic_mobility.hpp"
#include "jostle/hydrodynamics/rod_blobs.hpp"
#include "jostle/math/rotation.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/rods/space_filling_order.hpp"
#include "random_rods.hpp"

using namespace jostle;

namespace {

constexpr double pi = std::numbers::pi, viscosity = 0.7;
constexpr std::uint64_t seed = 20261125;
const Box open{{20, 20, 20}, {false, false, false}};

HydrodynamicMobility fluid(double tolerance = 1e-3, std::optional<double> cutoff = std::nullopt) {
    return HydrodynamicMobility(viscosity, tolerance, cutoff, SpheresTurn::with_fluid);
}

/// Spheres and, if `length` > 0, as many rods: anywhere, so that they may overlap.
Rods spheres_and_rods(Chance& chance, std::size_t spheres, double length, const Vec3& edges) {
    Rods rods = chance.rods(spheres, 0.0, edges);
    if (length == 0.0) return rods;
    const Rods longer = chance.rods(spheres, length, edges);
    for (std::size_t i = 0; i < spheres; ++i)
        rods.push_back(spheres + i, longer.centre[i], longer.axis[i], length, 1.0);
    return rods;
}

Vec3 across(const Rods& rods, std::size_t i, const Vec3& vector) {
    return vector - dot(vector, rods.axis[i]) * rods.axis[i];
}

/// Two spheres, `apart` from each other.
Rods two_spheres(const Vec3& apart) {
    Rods rods;
    rods.push_back(0, {1, 2, 3}, normalised(Vec3{1, 2, -0.5}), 0.0, 1.0);
    rods.push_back(1, Vec3{1, 2, 3} + apart, normalised(Vec3{-0.3, 1, 1}), 0.0, 1.0);
    return rods;
}

/// M as a matrix: force and torque of the first rod, of the next, ...
Eigen::MatrixXd matrix_of(const MobilityOperator& mobility, std::size_t count) {
    const auto size = static_cast<Eigen::Index>(6 * count);
    Eigen::MatrixXd matrix(size, size);
    for (Eigen::Index column = 0; column < size; ++column) {
        Forces unit(count);
        const auto rod = static_cast<std::size_t>(column / 6);
        (column % 6 < 3 ? unit.force : unit.torque)[rod][static_cast<int>(column % 3)] = 1.0;
        Velocities u;
        mobility.apply(unit, u);
        for (Eigen::Index row = 0; row < size; ++row)
            matrix(row, column) =
                (row % 6 < 3 ? u.linear : u.angular)[static_cast<std::size_t>(row / 6)][static_cast<int>(row % 3)];
    }
    return matrix;
}

}  // namespace

TEST_CASE("a sphere alone turns as Stokes says: 1/(pi mu D^3)") {
    for (const double diameter : {1.0, 1.7}) {
        Rods rods;
        rods.push_back(0, {1, 2, 3}, {0, 0, 1}, 0.0, diameter);
        Forces forces(1);
        forces.torque[0] = {1, -2, 0};
        const Velocities u = moved(fluid(), rods, open, forces);
        const double stokes = 1.0 / (pi * viscosity * std::pow(diameter, 3));
        CHECK(norm(u.angular[0] - stokes * forces.torque[0]) < 1e-12 * stokes);
        CHECK(norm(u.linear[0]) == 0.0);
    }
}

// No Faxen terms: vorticity is harmonic, so that its mean over any Gaussian is its value in the middle.
TEST_CASE("two spheres far apart: the rotlet T x R/(8 pi mu R^3), and couples by (3 RR/R^2 - I)/(16 pi mu R^3)") {
    for (const Vec3& apart : {Vec3{5, 0, 0}, Vec3{-3, 4, 2}, Vec3{0.1, -7, 12}}) {
        const Rods rods = two_spheres(apart);
        const double r = norm(apart), unit = 1.0 / (8.0 * pi * viscosity * r * r * r);
        const Vec3 torque = across(rods, 0, {0.4, 1, -2}), force{1, 0.3, -0.7};
        Forces turned(2), pushed(2);
        turned.torque[0] = torque;
        pushed.force[0] = force;
        const Velocities by_torque = moved(fluid(), rods, open, turned), by_force = moved(fluid(), rods, open, pushed);
        CHECK(norm(by_torque.linear[1] - unit * cross(torque, apart)) < 1e-6 * unit * r * norm(torque));
        const Vec3 spin = (0.5 * unit) * ((3.0 * dot(apart, torque) / (r * r)) * apart - torque);
        CHECK(norm(by_torque.angular[1] - across(rods, 1, spin)) < 1e-6 * unit * norm(torque));
        CHECK(norm(by_force.angular[1] - across(rods, 1, unit * cross(force, apart))) < 1e-6 * unit * r * norm(force));
    }
}

TEST_CASE("a sphere turns by half the vorticity of the flow of a rod") {
    Rods rods;
    rods.push_back(0, {0, 0, 0}, normalised(Vec3{0.2, 1, -0.5}), 3.0, 1.0);
    rods.push_back(1, {6, 1, -2}, normalised(Vec3{1, 1, 0.4}), 0.0, 1.0);
    Forces forces(2);
    forces.force[0] = {0.3, -1, 2};
    forces.torque[0] = across(rods, 0, {2, 0.5, -1});
    const Velocities u = moved(fluid(), rods, open, forces);
    const auto flow_at = [&](const Vec3& shift) {
        Rods shifted = rods;
        shifted.centre[1] += shift;
        return moved(fluid(), shifted, open, forces).linear[1];
    };
    const double step = 0.01;
    std::array<Vec3, 3> slope;  // of the velocity, along x, y, z
    for (int k = 0; k < 3; ++k) {
        Vec3 shift{};
        shift[k] = step;
        slope[static_cast<std::size_t>(k)] = (0.5 / step) * (flow_at(shift) - flow_at(-shift));
    }
    const Vec3 vorticity{slope[1].z - slope[2].y, slope[2].x - slope[0].z, slope[0].y - slope[1].x};
    CHECK(norm(u.angular[1] - across(rods, 1, 0.5 * vorticity)) < 1e-4 * norm(u.angular[1]));
}

// u = p (3 cos^2 theta - 1) R/(8 pi mu R^3) has half the vorticity 3 p (n.R) n x R/(8 pi mu R^5).
TEST_CASE("a sphere in the flow of one swimmer turns by half its vorticity") {
    const double dipole = -2.3;
    for (const double length : {0.0, 2.0})
        for (const Vec3& apart : {Vec3{60, 0, 0}, Vec3{20, -60, 30}}) {
            Rods rods = two_spheres(apart);
            rods.length[0] = length;
            Velocities u(2);
            fluid().at(rods, open)->add_axial_flow({.kT = 0.0, .dipole = {dipole, 0.0}}, u);
            const double r = norm(apart);
            const Vec3& axis = rods.axis[0];
            const Vec3 half =
                (3.0 * dipole * dot(axis, apart) / (8.0 * pi * viscosity * std::pow(r, 5))) * cross(axis, apart);
            const double allowed = length == 0.0 ? 1e-6 : 10.0 * (length + 1.0) * (length + 1.0) / (r * r);
            CHECK(norm(u.angular[1] - across(rods, 1, half)) < allowed * norm(half));
            CHECK(norm(u.angular[0]) == 0.0);  // its own flow does not turn it
        }
}

// The whole of M against the sum over the waves of the box, which the widths of blobs end: force and couple of a sphere
// are (F exp(-k^2 s/2) + i/2 k x T exp(-k^2 s'/2)), and so are velocity and turning of the other.
TEST_CASE("couples in a periodic box: against the sum over waves, for a force, a couple and a swimmer's dipole") {
    const Vec3 edges{7, 8, 9};
    const Rods rods = two_spheres({1.1, -0.7, 0.6});
    const double spread = blobs_of(rods, viscosity).spread(), of_couple = couple_spread(1.0);
    const Vec3 force{1, -0.4, 2}, torque = across(rods, 0, {0.4, 1, -2});
    const double dipole = 1.9;
    Forces acting(2);
    acting.force[0] = force;
    acting.torque[0] = torque;
    std::array<std::array<Vec3, 2>, 2> linear{}, angular{};  // [by force and torque, by dipole][rod]
    constexpr int waves = 28;
    for (int x = -waves; x <= waves; ++x)
        for (int y = -waves; y <= waves; ++y)
            for (int z = -waves; z <= waves; ++z) {
                if (x == 0 && y == 0 && z == 0) continue;
                const Vec3 k{2 * pi * x / edges.x, 2 * pi * y / edges.y, 2 * pi * z / edges.z};
                const double squared = squared_norm(k);
                if (squared * of_couple > 25.0) continue;
                const double on_force = std::exp(-0.5 * squared * spread);
                const double on_couple = std::exp(-0.5 * squared * of_couple);
                const Vec3 half_curl = (0.5 * on_couple) * cross(k, torque);
                const Vec3& axis = rods.axis[0];
                for (std::size_t rod = 0; rod < 2; ++rod) {
                    const double phase = dot(k, rods.centre[rod] - rods.centre[0]);
                    const double size = 1.0 / (viscosity * edges.x * edges.y * edges.z * squared);
                    // The flow at the rod is real part and imaginary part of `wave` times two real vectors.
                    const std::complex<double> wave = size * std::polar(1.0, phase);
                    const auto add = [&](std::size_t kind, const Vec3& real, const Vec3& imaginary) {
                        const auto solenoidal = [&](const Vec3& v) { return v - (dot(k, v) / squared) * k; };
                        const Vec3 a = solenoidal(real), b = solenoidal(imaginary);
                        linear[kind][rod] += on_force * (wave.real() * a - wave.imag() * b);
                        // 1/2 i k x (a + i b): real part of i wave, and of i i wave
                        angular[kind][rod] +=
                            (0.5 * on_couple) * (-wave.imag() * cross(k, a) - wave.real() * cross(k, b));
                    };
                    add(0, on_force * force, half_curl);
                    add(1, Vec3{}, (-dipole * dot(k, axis) * on_force) * axis);
                }
            }
    const Box box{edges};
    const Velocities by_forces = moved(fluid(1e-6), rods, box, acting);
    Velocities by_dipole(2);
    fluid(1e-6).at(rods, box)->add_axial_flow({.kT = 0.0, .dipole = {dipole, 0.0}}, by_dipole);
    const double rest = blobs_of(rods, viscosity).of(0).remainder.perpendicular;  // of the sphere's own block
    linear[0][0] += rest * force;
    for (std::size_t rod = 0; rod < 2; ++rod) {
        CHECK(norm(by_forces.linear[rod] - linear[0][rod]) < 1e-5 * norm(linear[0][rod]));
        CHECK(norm(by_forces.angular[rod] - across(rods, rod, angular[0][rod])) < 1e-5 * norm(angular[0][rod]));
    }
    CHECK(norm(by_dipole.linear[1] - linear[1][1]) < 1e-5 * norm(linear[1][1]));
    CHECK(norm(by_dipole.angular[1] - across(rods, 1, angular[1][1])) < 1e-5 * norm(angular[1][1]));
}

// The wave k = 0 is left out of the sum over waves, whose value there is the mean over directions, 2/3 of 1/(4 mu V):
// by Poisson's formula Omega = T [1/(pi mu D^3) - 1/(6 mu V)] + the images, whose dipole fields add up to nothing in a
// cube.
TEST_CASE("a sphere in a cubic box turns more slowly by the volume fraction: pi mu D^3 M = 1 - pi D^3/6 V") {
    for (const double edge : {3.0, 5.0, 10.0}) {
        Rods rods;
        rods.push_back(0, {1.1, 2.3, 0.7}, {1, 0, 0}, 0.0, 1.0);
        Forces forces(1);
        forces.torque[0] = {0.0, 0.3, -2.0};
        const double expected = 1.0 - pi / (6.0 * edge * edge * edge);
        for (const auto& [tolerance, allowed] : {std::pair(1e-6, 1e-6), std::pair(1e-3, 2e-3)}) {
            const Velocities u = moved(fluid(tolerance), rods, Box{{edge, edge, edge}}, forces);
            const double found = pi * viscosity * dot(u.angular[0], forces.torque[0]) / squared_norm(forces.torque[0]);
            CAPTURE(edge);
            CHECK(std::fabs(found - expected) < allowed);
        }
    }
}

TEST_CASE("with couples: where a periodic sum is split does not matter, and its error is within the tolerance") {
    Chance chance(seed);
    const Box box{{14, 15, 16}};
    for (const double length : {0.0, 5.0}) {
        const Rods rods = spheres_and_rods(chance, 12, length, box.edges());
        const Forces forces = chance.forces(rods);
        const Velocities exact = moved(fluid(1e-6, 5.0), rods, box, forces);
        for (const double tolerance : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2})
            for (const double cutoff : {2.0, 3.0, 4.0}) {
                CAPTURE(length);
                CAPTURE(tolerance);
                CAPTURE(cutoff);
                const auto [linear, angular] = errors(moved(fluid(tolerance, cutoff), rods, box, forces), exact);
                CHECK(linear < tolerance);
                CHECK(angular < 2.0 * tolerance);
            }
    }
}

TEST_CASE("with couples M is symmetric to rounding, and positive, for spheres and rods that overlap") {
    Chance chance(seed);
    for (const bool periodic : {true, false})
        for (const double length : {0.0, 3.0}) {
            const Box box{{4, 5, 6}, {periodic, periodic, periodic}};
            const Rods rods = spheres_and_rods(chance, 6, length, box.edges());
            const auto model = fluid();
            const auto mobility = model.at(rods, box);
            const Eigen::MatrixXd matrix = matrix_of(*mobility, rods.size());
            const double rounding = std::numeric_limits<float>::epsilon();
            CHECK((matrix - matrix.transpose()).norm() < rounding * matrix.norm());
            const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues();
            const auto spins = static_cast<Eigen::Index>(rods.size());  // about the axes: nothing answers
            const double nothing = rounding * eigenvalues(eigenvalues.size() - 1);
            CHECK(eigenvalues(0) > -nothing);
            CHECK(eigenvalues(spins - 1) < nothing);
            CHECK(eigenvalues(spins) > 1e-4);
        }
}

// As in test_hydrodynamic_mobility.cpp, also of a sphere: its couple has no divergence, but it turns in the flow of the
// thermal stresslets of rods.
TEST_CASE("the thermal drift is div M: three rods and one sphere, against central differences over all turns") {
    Chance chance(seed);
    for (const bool periodic : {false, true}) {
        const Box box{{30, 30, 30}, {periodic, periodic, periodic}};
        Rods rods = chance.rods(4, 5.0, {6, 6, 6});
        rods.length[3] = 0.0;
        const auto model = fluid(1e-6, periodic ? std::optional(6.0) : std::nullopt);
        Velocities drift(4), difference(4);
        model.at(rods, box)->add_axial_flow({.kT = 1.0, .dipole = {}}, drift);
        constexpr double angle = 1e-2;  // as there, for the rounding of floats
        for (std::size_t j = 0; j < 4; ++j)
            for (int k = 0; k < 3; ++k)
                for (const double sign : {-1.0, 1.0}) {
                    Vec3 turn{};
                    turn[k] = 1.0;
                    Rods turned = rods;
                    turned.axis[j] = rotated(rods.axis[j], sign * angle * turn);
                    Forces torque(4);
                    torque.torque[j] = turn;
                    const Velocities u = moved(model, turned, box, torque);
                    for (std::size_t i = 0; i < 4; ++i) {
                        difference.linear[i] += (0.5 * sign / angle) * u.linear[i];
                        // what turns the axis; M after the turn has another one
                        difference.angular[i] += (0.5 * sign / angle) * across(rods, i, u.angular[i]);
                    }
                }
        const auto [linear, angular] = errors(drift, difference);
        MESSAGE("relative differences: ", linear, " of velocities, ", angular, " of angular velocities");
        CHECK(linear < 1e-3);
        CHECK(angular < (periodic ? 2e-2 : 1e-3));
        const double sphere = norm(drift.angular[3] - difference.angular[3]);
        CHECK(norm(drift.angular[3]) > 1e-3);
        CHECK(sphere < 1e-3 * norm(drift.angular[3]));
    }
}

// As in test_hydrodynamic_mobility.cpp: <(y.U)^2> = y.M y for any forces and couples y. 24 of them, each known to a
// standard error of 2.8 %; the mean of the squares of their deviations, in standard errors, is 1 +- sqrt(2/24): 5 of
// these are a false alarm in 1e5, as the vectors are not quite independent. Half of the vectors are couples alone.
TEST_CASE("with couples noise has the covariance M") {
    Chance chance(seed);
    constexpr int vectors = 24, samples = 2500;
    for (const bool periodic : {false, true})
        for (const double length : {0.0, 3.0}) {
            const Box box{{4, 5, 6}, {periodic, periodic, periodic}};
            const Rods rods = spheres_and_rods(chance, length == 0.0 ? 16 : 8, length, box.edges());
            const auto model = fluid();
            const auto mobility = model.at(rods, box);
            std::vector<Forces> forces;
            for (int k = 0; k < vectors; ++k) {
                forces.push_back(chance.forces(rods));
                if (k % 2 == 0) forces.back().force.assign(rods.size(), Vec3{});
            }
            const auto [chi_squared, mean] = deviation_of_noise(*mobility, forces, samples, seed);
            MESSAGE("chi squared by degree of freedom ", chi_squared, ", mean deviation ", mean, " standard errors");
            CHECK(std::fabs(chi_squared - 1.0) < 5.0 * std::sqrt(2.0 / vectors));
            CHECK(std::fabs(mean) < 5.0 / std::sqrt(vectors));
        }
}

TEST_CASE("with couples flow, noise and drift have the same bits for any number of threads and any order of rows") {
    Chance chance(seed);
    for (const bool periodic : {true, false}) {
        const Box box{{22, 20, 18}, {periodic, periodic, periodic}};
        const Rods rods = spheres_and_rods(chance, 300, 2.0, box.edges());
        const Forces forces = chance.forces(rods);
        const auto all_of = [&](const Rods& these, const Forces& pushed, int threads) {
            parallel::set_thread_count(threads);
            const auto model = fluid();
            const auto mobility = model.at(these, box);
            Velocities u;
            mobility->apply(pushed, u);
            mobility->add_square_root({seed, 3, Stream::brownian, 0}, 1.5, u);
            mobility->add_axial_flow({.kT = 0.8, .dipole = std::vector<double>(these.size(), 3.0)}, u);
            return u;
        };
        CHECK(has_same_bits_always(rods, forces, all_of));
    }
    parallel::set_thread_count(1);
}

// Contacts act on the centres of spheres. Nothing of passive spheres depends on how they turn.
TEST_CASE("forces move spheres alike with and without couples, and among the rods of contacts") {
    Chance chance(seed);
    const Box box{{9, 10, 11}};
    const Rods rods = chance.rods(12, 0.0, box.edges());
    Forces forces = chance.forces(rods);
    forces.torque.assign(rods.size(), Vec3{});
    const double tolerance = 1e-5;
    const Velocities without = moved(HydrodynamicMobility(viscosity, tolerance, 3.0), rods, box, forces);
    const auto model = fluid(tolerance, 3.0);
    const auto mobility = model.at(rods, box);
    Velocities with, among;
    mobility->apply(forces, with);
    CHECK(errors(with, without)[0] < tolerance);
    CHECK(norm(with.angular[0]) > 0.0);
    std::vector<std::uint32_t> rows(rods.size());
    for (std::uint32_t row = 0; row < rows.size(); ++row) rows[row] = row;
    mobility->among(rows)->apply(forces, among);
    CHECK(among.linear == with.linear);
}
