// A mobility that couples rods, as hydrodynamic interactions would: spheres in pairs of twins, wherever they are, of
// which a force on one moves the other by half. It is the same at every place of the spheres, so equilibrium is that of
// any other mobility, though motion is not.

#include <doctest/doctest.h>

#include <cmath>

#include "jostle/error/input_error.hpp"
#include "jostle/motion/brownian_motion.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"
#include "jostle/statistics/time_series.hpp"

using namespace jostle;

namespace {

constexpr std::size_t count = 600;

/// M = m (1, c; c, 1) for the forces on ids 2k and 2k + 1, whose square root is sqrt(m) (p, q; q, p) with
/// p^2 + q^2 = 1 and 2 p q = c. Spheres do not turn.
class TwinMobility final : public Mobility {
public:
    explicit TwinMobility(double own) : own_(own) {}

    void update(const Rods&) override {}
    void apply(const Rods& rods, const Forces& forces, Velocities& velocities) const override {
        const std::vector<std::size_t> twin = twins(rods);
        for (std::size_t i = 0; i < rods.size(); ++i) {
            velocities.linear[i] = own_ * (forces.force[i] + coupling * forces.force[twin[i]]);
            velocities.angular[i] = {};
        }
    }
    void add_square_root(const Rods& rods, std::size_t first, std::span<const Normals> normals, double scale,
                         Velocities& velocities) const override {
        REQUIRE(first == 0);
        REQUIRE(normals.size() == rods.size());
        const double angle = 0.5 * std::asin(coupling), p = std::cos(angle), q = std::sin(angle);
        const std::vector<std::size_t> twin = twins(rods);
        for (std::size_t i = 0; i < rods.size(); ++i)
            for (int k = 0; k < 3; ++k) {
                const auto a = static_cast<std::size_t>(k);
                velocities.linear[i][k] += scale * std::sqrt(own_) * (p * normals[i][a] + q * normals[twin[i]][a]);
            }
    }
    bool couples_rods() const override { return true; }
    RodMobility of_rod(std::size_t) const override { return {own_, own_, 0.0}; }

    static std::vector<std::size_t> twins(const Rods& rods) {
        std::vector<std::size_t> row(rods.size()), twin(rods.size());
        for (std::size_t i = 0; i < rods.size(); ++i) row[rods.id[i]] = i;
        for (std::size_t i = 0; i < rods.size(); ++i) twin[i] = row[rods.id[i] ^ 1];
        return twin;
    }

    static constexpr double coupling = 0.5;

private:
    double own_;
};

Scene scene_of(double volume_fraction) {
    Scene scene;
    scene.seed = 20261123;
    scene.box.volume_fraction = volume_fraction;
    scene.rods.count = count;
    scene.rods.length = 0.0;
    scene.time.rms_step = 0.03;
    return scene;
}

/// The scene with twins, at the same step and temperature; `plain`, made of the scene, gives rods, box and settings.
Simulation with_twins(const Simulation& plain, SolverMethod method, double tolerance) {
    SimulationSettings settings = plain.settings();
    settings.method = method;
    settings.lcp.tolerance = tolerance;
    auto mobility = std::make_unique<TwinMobility>(plain.mobility().of_rod(0).parallel);
    std::vector<std::unique_ptr<Motion>> motions;
    motions.push_back(std::make_unique<BrownianMotion>(settings.kT, *mobility));
    return Simulation(plain.box(), plain.rods(), plain.clock(), std::move(mobility), std::move(motions), settings);
}

}  // namespace

TEST_CASE("contacts of rods that a mobility couples: all solvers for them agree, and forces move the twins, too") {
    const Scene scene = scene_of(0.45);
    const Box box{box_edges(scene), {true, true, true}};
    Simulation plain = assemble(scene, box, make_start(scene, box), {});
    for (int step = 0; step < 20; ++step) REQUIRE(plain.step().status == LcpStatus::converged);
    std::vector<Mat3> virials;
    for (const SolverMethod method : {SolverMethod::automatic, SolverMethod::adaptive_bb, SolverMethod::bbpgd,
                                      SolverMethod::apgd, SolverMethod::minimum_map_newton}) {
        Simulation simulation = with_twins(plain, method, 1e-8);
        const StepReport report = simulation.step();
        REQUIRE(report.status == LcpStatus::converged);
        virials.push_back(report.collision_virial);

        const ContactSolution& solution = simulation.contact_solution();
        REQUIRE(solution.rods.size() == count);
        Forces forces(count);
        Velocities expected(count);
        for (std::size_t k = 0; k < count; ++k) forces.force[solution.rods[k]] = solution.forces[k].force;
        simulation.mobility().apply(simulation.rods(), forces, expected);
        for (std::size_t k = 0; k < count; ++k)
            CHECK(norm(solution.velocities[k].centre - expected.linear[solution.rods[k]]) <
                  1e-9 * (1.0 + norm(expected.linear[solution.rods[k]])));
    }
    REQUIRE(norm(virials[0]) > 100.0);
    for (const Mat3& virial : virials) CHECK(norm(virial - virials[0]) < 1e-5 * norm(virials[0]));

    Simulation swept = with_twins(plain, SolverMethod::projected_sor, 1e-8);
    CHECK_THROWS_AS(swept.step(), InputError);
}

TEST_CASE("spheres that a mobility couples have the pressure of hard spheres") {
    constexpr double phi = 0.2;
    const double expected = (1 + phi + phi * phi - phi * phi * phi) / std::pow(1 - phi, 3);  // Carnahan-Starling
    const Scene scene = scene_of(phi);
    const Box box{box_edges(scene), {true, true, true}};
    const Simulation plain = assemble(scene, box, make_start(scene, box), {});
    Simulation simulation = with_twins(plain, SolverMethod::automatic, plain.settings().lcp.tolerance);
    std::vector<double> rows;
    for (int step = 0; step < 3500; ++step) {
        const StepReport report = simulation.step();
        REQUIRE(report.status == LcpStatus::converged);
        if (step >= 500) rows.push_back(1.0 + trace(report.collision_virial) / (3.0 * count));
    }
    const Average Z = average(rows);
    REQUIRE(Z.standard_error.has_value());
    MESSAGE("Z = ", Z.mean, " +- ", *Z.standard_error, ", expected ", expected);
    CHECK(*Z.standard_error < 0.012 * expected);  // or the comparison would say nothing
    CHECK(std::fabs(Z.mean - expected) <= 0.01 * expected + 2.0 * *Z.standard_error);
}
