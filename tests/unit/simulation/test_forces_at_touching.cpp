#include <doctest/doctest.h>

#include "jostle/hydrodynamics/hydrodynamic_mobility.hpp"
#include "jostle/simulation/forces_at_touching.hpp"

using namespace jostle;

// Two spheres with a gap of 0.2, pushed apart by 3, and a third one without contacts.
TEST_CASE("contact forces are measured with the mobility of touching bodies; velocities stay") {
    Rods rods;
    rods.push_back(0, {0, 0, 0}, {0, 0, 1}, 0.0, 1.0);
    rods.push_back(1, {1.2, 0, 0}, {0, 0, 1}, 0.0, 1.0);
    rods.push_back(2, {5, 5, 5}, {0, 0, 1}, 0.0, 1.0);
    const Box box{{20, 20, 20}, {false, false, false}};
    const HydrodynamicMobility model(1.0);
    const auto mobility = model.at(rods, box);
    Contacts contacts;
    contacts.push_back({.i = 0, .j = 1, .normal = {1, 0, 0}, .gap = 0.2}, {0, 0, 0}, ContactFeature::nearest);
    const ContactProblem problem(rods, *mobility, contacts, {-1.0}, 0.01);
    ContactSolution solution;
    solution.gamma = {3.0};
    problem.complete(solution);

    const ContactSolution touching = forces_at_touching(problem, solution, rods, *mobility);
    const double apart = mobility->relative_mobility({0, 1, 0.0, 0.0, {1, 0, 0}, 1.2});
    const double near = mobility->relative_mobility({0, 1, 0.0, 0.0, {1, 0, 0}, 1.0});
    CHECK(apart > 1.1 * near);  // the fluid hinders less those that are apart
    CHECK(touching.gamma[0] == doctest::Approx(3.0 * apart / near).epsilon(1e-14));
    CHECK(touching.forces[1].force.x == doctest::Approx(touching.gamma[0]).epsilon(1e-14));
    CHECK(touching.forces[0].force.x == doctest::Approx(-touching.gamma[0]).epsilon(1e-14));
    CHECK(touching.velocities[0].centre == solution.velocities[0].centre);
    CHECK(touching.velocities[2].centre == solution.velocities[2].centre);
}
