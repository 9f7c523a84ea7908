// Viscosity from the fluctuations of the stress at rest (theory, section 8). Statistical checks allow four standard
// errors (false alarm 6e-5 each).

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "jostle/measurement/measurement.hpp"
#include "jostle/stress/spherocylinder_moments.hpp"
#include "support/simulations.hpp"

using namespace jostle;
using test::started;

namespace {

Scene at_rest(std::uint64_t count, double length, double volume_fraction) {
    Scene scene;
    scene.seed = 31;
    scene.box.volume_fraction = volume_fraction;
    scene.rods.count = count;
    scene.rods.length = length;
    return scene;
}

nlohmann::ordered_json viscosity_of(const Scene& scene) {
    Simulation simulation = started(scene);
    Measurement measurement(scene, simulation);
    while (!measurement.is_complete()) measurement.add(simulation.step(), simulation);
    return measurement.summary(simulation)["viscosity_at_rest"];
}

std::string reason_of(const Scene& scene) {
    const auto entry = viscosity_of(scene);
    CHECK(entry["mean"].is_null());
    CHECK(entry["standard_error"].is_null());
    return entry["no_standard_error_because"];
}

double rotational_diffusion(Scene scene) {
    scene.time.step = 1e-3;
    const Simulation simulation = started(scene);
    return simulation.mobility().at(simulation.rods(), simulation.box())->of_rod(0).rotational;
}

}  // namespace

// All of it is in the orientation stress, which decays with 6 D_R: n kT B^2/(10 D_R).
TEST_CASE("free rods have the viscosity of Smoluchowski's equation") {
    Scene scene = at_rest(40, 5.0, 1e-9);
    const double diffusion = rotational_diffusion(scene);
    scene.time.step = 0.005 / diffusion;
    scene.time.equilibration = 2.0 / diffusion;
    scene.time.production = 1000.0 / diffusion;
    scene.output.series_every = 4;
    Simulation simulation = started(scene);
    const double density = 40.0 / simulation.box().volume(), B = moment_anisotropy(5.0);
    const double known = density * B * B / (10.0 * diffusion);
    const auto viscosity = viscosity_of(scene);
    CAPTURE(viscosity.dump());
    REQUIRE(!viscosity["mean"].is_null());
    const double mean = viscosity["mean"], error = viscosity["standard_error"];
    MESSAGE("viscosity over that of Smoluchowski's equation: ", mean / known, " +- ", error / known);
    CHECK(error < 0.1 * known);
    CHECK(std::fabs(mean - known) < 4.0 * error);
    CHECK(viscosity["definition"].get<std::string>().find("without the fluid's own viscosity") != std::string::npos);
}

TEST_CASE("a viscosity at rest is refused in words where it does not hold") {
    Scene scene = at_rest(40, 0.0, 0.2);
    scene.time.rms_step = 0.1;
    scene.time.equilibration = 20.0;
    scene.time.production = 150.0;  // 16 diffusion times
    CHECK(reason_of(scene).find("at least 24 are needed") != std::string::npos);
    Scene other = scene;
    other.rods.length = 1.0;
    other.rods.count = 20;
    other.output.series_every = 200;
    other.time.production = 400.0;
    other.box.volume_fraction = 0.01;
    CHECK(reason_of(other).find("lower output.series_every") != std::string::npos);
    other = scene;
    other.box.periodic = {true, true, false};
    CHECK(reason_of(other).find("not periodic") != std::string::npos);
    other = scene;
    other.motion.self_propulsion = 1.0;
    CHECK(reason_of(other).find("drives") != std::string::npos);
    other = scene;
    other.pressure.external = 1.0;
    CHECK(reason_of(other).find("pressure control") != std::string::npos);
    other = scene;
    other.forces.alignment_energy = 1.0;
    other.rods.length = 1.0;
    CHECK(reason_of(other).find("Forces from outside") != std::string::npos);
}
