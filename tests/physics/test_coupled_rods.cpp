// A mobility that couples rods, as hydrodynamic interactions would: spheres in pairs of twins, wherever they are, of
// which a force on one moves the other by half. It is the same at every place of the spheres, so equilibrium is that of
// any other mobility, though motion is not.

#include <doctest/doctest.h>

#include <cmath>

#include "jostle/contact_problem/delassus_operator.hpp"
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
class TwinOperator final : public MobilityOperator {
public:
    TwinOperator(const Rods& all, double own) : MobilityOperator(all), own_(own), twin_(all.size()) {
        std::vector<std::size_t> row(all.size());
        for (std::size_t i = 0; i < all.size(); ++i) row[all.id[i]] = i;
        for (std::size_t i = 0; i < all.size(); ++i) twin_[i] = row[all.id[i] ^ 1];
    }

    void apply(const Forces& forces, Velocities& velocities) const override {
        velocities.resize(twin_.size());
        for (std::size_t i = 0; i < twin_.size(); ++i) {
            velocities.linear[i] = own_ * (forces.force[i] + coupling * forces.force[twin_[i]]);
            velocities.angular[i] = {};
        }
    }
    void add_square_root(const RandomKey& key, double scale, Velocities& velocities) const override {
        const double angle = 0.5 * std::asin(coupling), p = std::cos(angle), q = std::sin(angle);
        std::vector<Normals> normals(twin_.size());
        fill_normals(key, rods().id, normals);
        for (std::size_t i = 0; i < twin_.size(); ++i)
            for (int k = 0; k < 3; ++k) {
                const auto a = static_cast<std::size_t>(k);
                velocities.linear[i][k] += scale * std::sqrt(own_) * (p * normals[i][a] + q * normals[twin_[i]][a]);
            }
    }
    bool couples_rods() const override { return true; }
    RodMobility of_rod(std::size_t) const override { return {own_, own_, 0.0}; }
    double relative_mobility(const PairOfPoints& points) const override {
        const bool twins = twin_[points.i] == points.j;
        return 2.0 * own_ * (twins ? 1.0 - coupling : 1.0) * squared_norm(points.normal);
    }

    static constexpr double coupling = 0.5;

private:
    double own_;
    std::vector<std::size_t> twin_;
};

class TwinMobility final : public Mobility {
public:
    explicit TwinMobility(double own) : own_(own) {}
    std::unique_ptr<const MobilityOperator> at(const Rods& rods, const Box&) const override {
        return std::make_unique<TwinOperator>(rods, own_);
    }

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
    auto mobility = std::make_unique<TwinMobility>(plain.mobility().at(plain.rods(), plain.box())->of_rod(0).parallel);
    std::vector<std::unique_ptr<Motion>> motions;
    motions.push_back(std::make_unique<BrownianMotion>(settings.kT));
    return Simulation(plain.state(), std::move(mobility), std::move(motions), settings);
}

}  // namespace

TEST_CASE("contacts of rods that a mobility couples: all solvers for them agree, and forces move the twins, too") {
    const Scene scene = scene_of(0.45);
    const Box box{box_edges(scene), {true, true, true}};
    Simulation plain = assemble(scene, {box, make_start(scene, box)});
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
        simulation.mobility().at(simulation.rods(), box)->apply(forces, expected);
        for (std::size_t k = 0; k < count; ++k)
            CHECK(norm(solution.velocities[k].centre - expected.linear[solution.rods[k]]) <
                  1e-9 * (1.0 + norm(expected.linear[solution.rods[k]])));
    }
    REQUIRE(norm(virials[0]) > 100.0);
    for (const Mat3& virial : virials) CHECK(norm(virial - virials[0]) < 1e-5 * norm(virials[0]));

    Simulation swept = with_twins(plain, SolverMethod::projected_sor, 1e-8);
    CHECK_THROWS_AS(swept.step(), InputError);
}

// Spheres 0 and 1 are twins:  (0)(1)(2)
TEST_CASE("the diagonal of the contact problem is the true one, also of rods that the mobility couples") {
    Rods rods;
    for (std::uint64_t id = 0; id < 4; ++id)
        rods.push_back(id, {1.0 + static_cast<double>(id), 5, 5}, {0, 0, 1}, 0.0, 1.0);
    const Box box{{20, 20, 20}, {true, true, true}};
    Contacts contacts;
    for (const std::uint32_t i : {0u, 1u, 2u})
        contacts.push_back({.i = i, .j = i + 1, .normal = {1, 0, 0}}, {0, 0, 0}, ContactFeature::nearest);
    const ContactMatrix D(contacts, rods.id, ContactMatrix::Include::all_rods);
    const TwinMobility model(0.3);
    const auto mobility = model.at(rods, box);
    const DelassusOperator A(D, rods, *mobility, 0.25);
    for (std::size_t l = 0; l < 3; ++l) {
        CAPTURE(l);
        std::vector<double> unit(3, 0.0), rates(3);
        unit[l] = 1.0;
        A.apply(unit, rates);
        CHECK(A.diagonal()[l] == doctest::Approx(rates[l]).epsilon(1e-14));
        CHECK(A.diagonal()[l] == doctest::Approx(1.25 * (l == 1 ? 0.6 : 0.3)).epsilon(1e-14));
    }
}

TEST_CASE("spheres that a mobility couples have the pressure of hard spheres") {
    constexpr double phi = 0.2;
    const double expected = (1 + phi + phi * phi - phi * phi * phi) / std::pow(1 - phi, 3);  // Carnahan-Starling
    const Scene scene = scene_of(phi);
    const Box box{box_edges(scene), {true, true, true}};
    const Simulation plain = assemble(scene, {box, make_start(scene, box)});
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
