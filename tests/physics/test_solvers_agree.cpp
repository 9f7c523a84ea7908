#include <doctest/doctest.h>

#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"

using namespace jostle;

TEST_CASE("all solvers, step rules and residuals give the same forces on the rods and the same stress") {
    // Isotropic rods, a nematic (two- and three-point contacts), spheres; then contacts that do not give way, where A
    // is singular and only what rods feel is unique.
    struct Case {
        double length;
        StartKind start;
        std::uint64_t count;
        Vec3 edges;
        bool correction = true;
    };
    for (const auto& [length, kind, count, edges, correction] :
         {Case{5.0, StartKind::random, 60, {9, 9, 9}}, Case{5.0, StartKind::aligned, 80, {13, 7.8, 7.8}},
          Case{0.0, StartKind::random, 200, {6.5, 6.5, 6.5}}, Case{3.0, StartKind::aligned, 12, {9, 3.0, 3.0}},
          Case{5.0, StartKind::random, 60, {9, 9, 9}, false},
          Case{5.0, StartKind::aligned, 80, {13, 7.8, 7.8}, false}}) {
        Scene scene;
        scene.rods.count = count;
        scene.rods.length = length;
        scene.rods.start = kind;
        scene.time.rms_step = 0.03;
        scene.contact.brownian_correction = correction;
        scene.solver.tolerance = 1e-7;
        scene.solver.max_iterations = 200000;
        const Box small{edges, {true, true, true}};
        // Some steps first: perfectly parallel rods are too easy.
        Simulation settled = assemble(scene, {small, make_start(scene, small)});
        for (int step = 0; step < 10; ++step) REQUIRE(settled.step().status == LcpStatus::converged);
        std::vector<Mat3> virials;
        std::vector<std::vector<Vec3>> forces;  // (solvers, N)
        const auto solve = [&]() {
            Simulation simulation = assemble(scene, settled.state());
            const StepReport report = simulation.step();
            REQUIRE(report.status == LcpStatus::converged);
            virials.push_back(report.collision_virial);
            const ContactSolution& solution = simulation.contact_solution();
            std::vector<Vec3>& force = forces.emplace_back(count);
            for (std::size_t k = 0; k < solution.rods.size(); ++k) force[solution.rods[k]] = solution.forces[k].force;
        };
        scene.solver.method = SolverMethod::projected_sor;
        solve();
        scene.solver.method = SolverMethod::bbpgd;
        for (const StepRule rule : {StepRule::bb1, StepRule::bb2, StepRule::alternating}) {
            scene.solver.step_rule = rule;
            solve();
        }
        for (const SolverMethod method :
             {SolverMethod::adaptive_bb, SolverMethod::apgd, SolverMethod::minimum_map_newton}) {
            scene.solver.method = method;
            solve();
        }
        scene.solver.method = SolverMethod::bbpgd;
        scene.solver.residual = ResidualKind::paper;
        solve();
        scene.solver.method = SolverMethod::projected_sor;
        solve();
        REQUIRE(norm(virials[0]) > 1.0);
        double largest_force = 0.0;
        for (const Vec3& force : forces[0]) largest_force = std::max(largest_force, norm(force));
        for (std::size_t k = 1; k < virials.size(); ++k) {
            CHECK(norm(virials[k] - virials[0]) < 1e-4 * norm(virials[0]));
            for (std::size_t i = 0; i < count; ++i) CHECK(norm(forces[k][i] - forces[0][i]) < 1e-3 * largest_force);
        }
    }
}
