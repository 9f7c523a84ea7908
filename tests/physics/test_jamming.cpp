// Spheres without thermal motion under the pressure of a bath: a jammed packing at rest, whose pressure and number of
// contacts are known exactly (theory, section 10).

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"

using namespace jostle;

namespace {

struct Packing {
    double volume_fraction = 0.0, pressure = 0.0, largest_force = 0.0, unbalanced = 0.0;
    std::size_t contacts = 0, bearing = 0;  ///< contacts with a force, and spheres that have some
    std::vector<Vec3> centre;
};

Packing jammed(double pressure) {
    constexpr double count = 64.0;
    Scene scene;
    scene.rods.count = 64;
    scene.rods.length = 0.0;
    scene.box.volume_fraction = 0.3;
    scene.fluid.kT = 0.0;
    scene.pressure.external = pressure;
    scene.solver.tolerance = 1e-8;
    scene.solver.max_iterations = 1000000;
    const double edge = std::cbrt(count * std::numbers::pi / 6.0 / 0.3);
    const Box box{{edge, edge, edge}};
    Simulation simulation = assemble(scene, {box, make_start(scene, box)});
    StepReport report;
    for (int k = 0; k < 600; ++k) {
        report = simulation.step();
        REQUIRE(report.status == LcpStatus::converged);
    }
    Packing packing;
    const double volume = simulation.box().volume();
    packing.volume_fraction = count * std::numbers::pi / 6.0 / volume;
    packing.pressure = trace(report.collision_virial) / (3.0 * volume);
    const Contacts& contacts = simulation.contacts();
    const std::vector<double>& gamma = simulation.contact_solution().gamma;
    for (const double force : gamma) packing.largest_force = std::max(packing.largest_force, force);
    std::set<std::uint32_t> bearing;
    for (std::size_t l = 0; l < gamma.size(); ++l) {
        if (gamma[l] < 1e-6 * packing.largest_force) continue;
        ++packing.contacts;
        bearing.insert({contacts.contact[l].i, contacts.contact[l].j});
    }
    packing.bearing = bearing.size();
    for (const ContactForce& on_rod : simulation.contact_solution().forces)
        packing.unbalanced = std::max(packing.unbalanced, norm(on_rod.force));
    packing.centre = simulation.rods().centre;
    return packing;
}

}  // namespace

TEST_CASE("spheres jam at the pressure of the bath, isostatic and in balance, and at twice the pressure alike") {
    const Packing once = jammed(1.0);
    MESSAGE("phi " << once.volume_fraction << ", pressure " << once.pressure << ", " << once.contacts << " contacts of "
                   << once.bearing << " spheres, largest force " << once.largest_force << ", unbalanced "
                   << once.unbalanced);
    CHECK(once.pressure == doctest::Approx(1.0).epsilon(1e-5));
    CHECK(once.contacts == 3 * once.bearing - 2);
    CHECK(once.bearing > 50);
    CHECK(once.unbalanced < 1e-4 * once.largest_force);
    // Packings of 64 spheres scatter by some 0.01 about 0.63; crystals fill 0.74, loose ones less than 0.6.
    CHECK(once.volume_fraction > 0.60);
    CHECK(once.volume_fraction < 0.66);

    const Packing twice = jammed(2.0);
    CHECK(twice.volume_fraction == doctest::Approx(once.volume_fraction).epsilon(1e-6));
    CHECK(twice.largest_force == doctest::Approx(2.0 * once.largest_force).epsilon(1e-6));
}
