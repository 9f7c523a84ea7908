// Exact relations of rods between walls (theory, section 6). Statistical checks allow four standard errors of their own
// sample (false alarm 6e-5 each).

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "jostle/contact/wca_forces.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"
#include "jostle/stress/spherocylinder_moments.hpp"
#include "support/sample.hpp"

using namespace jostle;
using test::Sample;

namespace {

Scene scene_of(double length, std::uint64_t count, double rms_step) {
    Scene scene;
    scene.rods.count = count;
    scene.rods.length = length;
    scene.time.rms_step = rms_step;
    scene.output.stress_per_rod = true;  // keeps the parts of the stress
    return scene;
}

/// Of each rod, by its id, means over steps.
struct OfEachRod {
    std::vector<double> force;             ///< sum of its wall forces
    std::vector<double> squared_nz;        ///< n_z^2
    std::vector<double> geometric;         ///< zz of its geometric stress
    std::vector<double> stress_less_wall;  ///< V Sigma_zz and the moment of its weight, less H P of both walls

    explicit OfEachRod(std::size_t count)
        : force(count), squared_nz(count), geometric(count), stress_less_wall(count) {}
};

/// Rods in a slit across z so wide that they do not meet: every rod is a sample of its own. (Blocks of time are not:
/// what a rod does at one wall is made up for at the other, as late as it gets there.)
OfEachRod ideal_rods_in_slit(const Scene& scene, double width, int settling, int steps) {
    const Box box{{1e5, 1e5, width}, {true, true, false}, {{false, false, true}}};
    Simulation simulation = assemble(scene, {box, make_start(scene, box)});
    OfEachRod means(simulation.rods().size());
    const double B = moment_anisotropy(scene.rods.length / scene.rods.diameter), each = 1.0 / steps;
    for (int k = 0; k < settling; ++k) simulation.step();
    for (int k = 0; k < steps; ++k) {
        const Rods& rods = simulation.rods();
        for (std::size_t i = 0; i < rods.size(); ++i)
            means.stress_less_wall[rods.id[i]] += each * scene.forces.on_rods.z * (rods.centre[i].z - 0.5 * width);
        REQUIRE(simulation.step().status == LcpStatus::converged);
        for (const CollisionMoments::Pair& pair : simulation.collision_moments().pairs) {
            REQUIRE(is_id_of_fixed(pair.id_i));
            means.force[pair.id_j] += each * norm(pair.force);
            means.stress_less_wall[pair.id_j] += each * (pair.moment()(2, 2) - 0.5 * width * norm(pair.force));
        }
        for (const CollisionMoments::Body& body : simulation.collision_moments().bodies) {
            means.geometric[body.id] += each * body.geometric(2, 2);
            means.stress_less_wall[body.id] += each * body.geometric(2, 2);
        }
        for (std::size_t i = 0; i < rods.size(); ++i) {
            const double squared = rods.axis[i].z * rods.axis[i].z;
            means.squared_nz[rods.id[i]] += each * squared;
            means.stress_less_wall[rods.id[i]] += each * (1.0 - 3.0 * B * (squared - 1.0 / 3.0));
        }
    }
    return means;
}

}  // namespace

TEST_CASE(
    "ideal rods in a slit: pressure, order and geometric stress are the exact ones; wall and whole stress agree") {
    const double length = 5.0, width = 8.0, a = width - 1.0;
    const OfEachRod rods = ideal_rods_in_slit(scene_of(length, 1500, 0.1), width, 0, 4000);
    const double nz = (a / 3.0 - length / 4.0) / (a - length / 2.0);
    const double B = moment_anisotropy(length);
    std::vector<double> pressure;
    for (const double force : rods.force) pressure.push_back(0.5 * force * width);
    const Sample P(pressure);
    MESSAGE("P/(nkT) = " << P.mean << " +- " << P.error << ", exact " << width / (a - length / 2.0));
    CHECK(P.error < 0.012 * P.mean);
    CHECK(P.agrees_with(width / (a - length / 2.0)));  // 1.777778
    CHECK(Sample(rods.squared_nz).agrees_with(nz));
    CHECK(Sample(rods.geometric).agrees_with(3.0 * B * (nz - 1.0 / 3.0)));
    const Sample difference(rods.stress_less_wall);
    CHECK(difference.agrees_with(0.0));
    CHECK(difference.error < 0.03);  // without the orientation stress it would be 0.265
}

TEST_CASE("ideal rods in a slit under their weight: the walls feel the whole stress and the moment of the weight") {
    Scene scene = scene_of(3.0, 1500, 0.1);
    scene.forces.on_rods = {0, 0, -0.7};
    const OfEachRod rods = ideal_rods_in_slit(scene, 8.0, 4000, 5000);
    const Sample difference(rods.stress_less_wall);
    MESSAGE("V(Sigma_zz + moment - P_w)/kT of a rod = " << difference.mean << " +- " << difference.error);
    CHECK(difference.error < 0.04);  // the moment is 1.099, the orientation stress 0.234
    CHECK(difference.agrees_with(0.0));
}

TEST_CASE(
    "ideal soft rods in a slit: the wall force is that of their Boltzmann weights, and the stress that of the walls") {
    // Each end feels the potential of both planes. The force on each is kT d ln Z/dH, by quadrature.
    const double length = 2.0, width = 5.0;
    const auto potential = [](double gap) {
        const double r = gap + 1.0;
        if (r >= wca_range) return 0.0;
        if (r <= 0.3) return 1e3;
        const double sixth = std::pow(r, -6.0);
        return 4.0 * sixth * (sixth - 1.0) + 1.0;
    };
    const auto weights = [&](double H) {
        double sum = 0.0;
        constexpr int points = 400;
        for (int i = 0; i < points; ++i)
            for (int j = 0; j < points; ++j) {
                const double z = H * (i + 0.5) / points, rise = 0.5 * length * (j + 0.5) / points;
                double energy = 0.0;
                for (const double end : {z - rise, z + rise}) energy += potential(end - 0.5) + potential(H - end - 0.5);
                sum += H / points * std::exp(-energy);
            }
        return sum;
    };
    const double exact = (std::log(weights(width + 0.01)) - std::log(weights(width - 0.01))) / 0.02;
    Scene scene = scene_of(length, 1500, 0.02);
    scene.contact.model = ContactModel::wca;
    const OfEachRod rods = ideal_rods_in_slit(scene, width, 6000, 12000);
    std::vector<double> of_a_plane;
    for (const double force : rods.force) of_a_plane.push_back(0.5 * force);
    const Sample F(of_a_plane);
    MESSAGE("force on each plane = " << F.mean << " +- " << F.error << ", exact " << exact);
    CHECK(F.error < 0.02 * exact);
    CHECK(F.agrees_with(exact));
    CHECK(Sample(rods.stress_less_wall).agrees_with(0.0));
}

TEST_CASE("ideal rods in a sphere: the wall force is that of the overlap of two balls") {
    // One rod to a cavity of its own.
    const double length = 2.0, q = 3.5, pi = std::numbers::pi;
    const double exact = (4.0 * pi * q * q - 2.0 * pi * q * length) /
                         (4.0 / 3.0 * pi * q * q * q - pi * q * q * length + pi / 12.0 * std::pow(length, 3.0));
    CHECK(exact == doctest::Approx(1.05));
    std::vector<double> force;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        Scene scene = scene_of(length, 1, 0.1);
        scene.seed = seed;
        const Box box{{8, 8, 8}, {false, false, false}, {{}, Container::sphere}};
        Simulation simulation = assemble(scene, {box, make_start(scene, box)});
        double sum = 0.0;
        const int steps = 10000;
        for (int k = 0; k < steps; ++k) sum += simulation.step().wall_force[container_number] / steps;
        force.push_back(sum);
    }
    const Sample F(force);
    MESSAGE("sum of forces = " << F.mean << " +- " << F.error << " kT/D, exact " << exact);
    CHECK(F.error < 0.04 * F.mean);
    CHECK(F.agrees_with(exact));
}

TEST_CASE("a plane that comes nearer pushes a sphere before it with the force that its speed takes") {
    const double speed = 0.3;
    Scene scene = scene_of(0.0, 1, 0.1);
    scene.time.rms_step.reset();
    scene.time.step = 1e-2;
    scene.time.production = 10.0;
    scene.motion.brownian = false;
    scene.solver.tolerance = 1e-10;
    scene.box.edges = Vec3{6, 6, 8};
    scene.box.periodic = {true, true, false};
    scene.walls.faces = {false, false, true};
    scene.schedule.edges = {{10.0, {6, 6, 8 - 10.0 * speed}}};
    const Box box{{6, 6, 8}, {true, true, false}, {{false, false, true}}};
    Rods rods;
    rods.push_back(0, {3, 3, 7.5}, {1, 0, 0}, 0.0, 1.0);
    Simulation simulation = assemble(scene, {box, rods});
    const double mobility = simulation.mobility().at(rods, box)->of_rod(0).perpendicular;
    for (int k = 1; k <= 100; ++k) {
        const StepReport report = simulation.step();
        REQUIRE(report.status == LcpStatus::converged);
        CHECK(report.wall_force[5] == doctest::Approx(speed / mobility).epsilon(1e-6));
        CHECK(report.wall_force[4] == 0.0);
    }
    CHECK(simulation.box().edges().z == doctest::Approx(8.0 - speed));
    CHECK(simulation.rods().centre[0].z == doctest::Approx(7.5 - speed).epsilon(1e-6));
    CHECK(simulation.rods().centre[0].x == 3.0);
}

TEST_CASE("a swimmer without noise presses on a plane with (6.6), and turns along it as (6.7) has it") {
    const double length = 5.0, alpha = std::numbers::pi / 3.0, U = 1.0;
    Scene scene = scene_of(length, 1, 0.1);
    scene.time.rms_step.reset();
    scene.time.step = 1e-3;
    scene.motion.brownian = false;
    scene.motion.self_propulsion = U;
    scene.solver.tolerance = 1e-12;
    const Box box{{40, 40, 40}, {true, true, false}, {{false, false, true}}};
    Rods rods;  // its head touches the upper plane
    rods.push_back(0, {20, 20, 39.5 - 0.5 * length * std::sin(alpha)}, {std::cos(alpha), 0, std::sin(alpha)}, length,
                   1.0);
    Simulation simulation = assemble(scene, {box, rods});
    const RodMobility m = simulation.mobility().at(rods, box)->of_rod(0);
    const double across = m.perpendicular + 0.25 * m.rotational * length * length;
    const double force = simulation.step().wall_force[5];
    const double exact =
        U * std::sin(alpha) / (m.parallel * std::pow(std::sin(alpha), 2.0) + across * std::pow(std::cos(alpha), 2.0));
    CHECK(force == doctest::Approx(exact).epsilon(1e-6));
    const auto potential = [&](double angle) {
        return -m.parallel * std::log(std::cos(angle)) + across * std::log(std::sin(angle));
    };
    const double end = std::numbers::pi / 18.0;
    const double time = 2.0 * (potential(alpha) - potential(end)) / (m.rotational * length * U);
    const auto angle = [&] { return std::asin(simulation.rods().axis[0].z); };
    double before = angle();
    while (angle() > end) {
        before = angle();
        REQUIRE(simulation.step().status == LcpStatus::converged);
        REQUIRE(simulation.clock().time < 2.0 * time);
    }
    const double part = (before - end) / (before - angle());  // of the last step
    CHECK(simulation.clock().time - (1.0 - part) * 1e-3 == doctest::Approx(time).epsilon(2e-3));
}
