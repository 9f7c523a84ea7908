// A plane that a bath of pressure moves, without thermal motion (theory, section 10).

#include <doctest/doctest.h>

#include <numbers>

#include "jostle/setup/assemble.hpp"

using namespace jostle;

namespace {

/// Spheres in a tube along x, so narrow that none passes another, its upper end a piston under a load.
Scene row_of(std::uint64_t count, double radius, double distance, double load) {
    Scene scene;
    scene.rods.count = count;
    scene.rods.length = 0.0;
    scene.walls.container = Container::tube;
    scene.walls.axis = Direction::x;
    scene.walls.faces = {true, false, false};
    scene.box.periodic = {false, false, false};
    scene.box.edges = Vec3{static_cast<double>(count) * distance, 2.0 * radius, 2.0 * radius};
    scene.pressure.external = load / (std::numbers::pi * radius * radius);
    scene.pressure.coupling = StrainCoupling::piston;
    return scene;
}

State row_at(const Scene& scene, double distance) {
    State state;
    state.box = Box{*scene.box.edges, {false, false, false}, {{true, false, false}, Container::tube, 0}};
    const double radius = 0.5 * scene.box.edges->y;
    for (std::uint64_t k = 0; k < scene.rods.count; ++k)
        state.rods.push_back(k, {(static_cast<double>(k) + 0.5) * distance, radius, radius}, {1, 0, 0}, 0.0, 1.0);
    return state;
}

}  // namespace

TEST_CASE("a row without thermal motion is pressed together until it bears the load of the piston") {
    Scene scene = row_of(5, 0.5, 1.5, 10.0);
    scene.fluid.kT = 0.0;
    scene.solver.tolerance = 1e-8;
    Simulation row = assemble(scene, row_at(scene, 1.5));
    StepReport last;
    for (int k = 0; k < 2000; ++k) {
        last = row.step();
        REQUIRE(last.status == LcpStatus::converged);
    }
    MESSAGE("length " << row.box().edges().x << ", force " << last.wall_force[1] << ", " << last.wall_force[0]);
    CHECK(row.box().edges().x == doctest::Approx(5.0).epsilon(1e-5));
    CHECK(last.wall_force[1] == doctest::Approx(10.0).epsilon(1e-4));
    CHECK(last.wall_force[0] == doctest::Approx(last.wall_force[1]).epsilon(1e-4));
}
