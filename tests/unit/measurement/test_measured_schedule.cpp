// What is measured while a schedule changes box and kT: rows and fields are means of stresses of single steps, and
// nothing is called equilibrated before the schedule is over.

#include <doctest/doctest.h>

#include "jostle/measurement/measurement.hpp"
#include "support/simulations.hpp"

using namespace jostle;
using test::started;

namespace {

Scene squeezed() {
    Scene scene;
    scene.seed = 3;
    scene.box.volume_fraction = 0.2;
    scene.rods.count = 50;
    scene.rods.length = 2.0;
    scene.time.step = 0.004;
    scene.time.production = 0.16;
    scene.time.equilibration = 0.0;
    scene.schedule.volume_fraction = {{0.16, 0.4}};
    scene.schedule.kT = {{0.16, 3.0}};
    scene.output.series_every = 10;
    scene.output.field_every = 10;
    scene.output.field_spacing = 3.0;
    return scene;
}

}  // namespace

TEST_CASE("a row is the mean over its steps of stress, density and kT, each step by its own box") {
    const Scene scene = squeezed();
    Simulation simulation = started(scene);
    Measurement measurement(scene, simulation);
    for (int row = 0; row < 4; ++row) {
        double collision = 0.0, density = 0.0, kT = 0.0, xy = 0.0;
        for (int step = 0; step < 10; ++step) {
            const StepReport report = simulation.step();
            const double volume = simulation.box().volume();
            collision += trace(report.collision_virial) / 3.0 / volume / 10.0;
            xy += report.collision_virial(0, 1) / volume / 10.0;
            density += static_cast<double>(report.rods) / volume / 10.0;
            kT += simulation.settings().kT / 10.0;
            measurement.add(report, simulation);
        }
        const auto last = [&](const char* name) { return measurement.series().column(name).back(); };
        CHECK(collision > 0.0);
        CHECK(last("pressure_collision") == doctest::Approx(collision).epsilon(1e-12));
        CHECK(last("stress_xy") == doctest::Approx(xy).epsilon(1e-12));
        CHECK(last("pressure") == doctest::Approx(density * kT + collision).epsilon(1e-12));
        CHECK(last("Z") == doctest::Approx(1.0 + collision / (density * kT)).epsilon(1e-12));
        // The columns of a field: ..., number density, nine of the collision stress.
        const auto columns = field_columns(scene).about();
        double mean_density = 0.0, mean_pressure = 0.0;
        for (const auto& cell : measurement.last_field())
            for (std::size_t k = 0; k < columns.size(); ++k) {
                const double part = cell[k] / static_cast<double>(measurement.last_field().size());
                if (columns[k].name == "number_density") mean_density += part;
                if (columns[k].name == "stress_xx" || columns[k].name == "stress_yy" || columns[k].name == "stress_zz")
                    mean_pressure += part / 3.0;
            }
        CHECK(mean_density == doctest::Approx(density).epsilon(1e-12));
        CHECK(mean_pressure == doctest::Approx(collision).epsilon(1e-12));
    }
}

TEST_CASE("sums of half a row that go through a checkpoint are those of the whole row") {
    const Scene scene = squeezed();
    Simulation simulation = started(scene);
    Measurement whole(scene, simulation);
    for (int step = 0; step < 5; ++step) whole.add(simulation.step(), simulation);
    Measurement later(scene, simulation, StepSums::from_named(whole.sums().to_named(), scene, simulation.box()));
    for (int step = 0; step < 5; ++step) {
        const StepReport report = simulation.step();
        whole.add(report, simulation);
        later.add(report, simulation);
    }
    CHECK(whole.last_row() == later.last_row());
    CHECK(whole.last_field() == later.last_field());
}

TEST_CASE("averages over a ramp have no error bars; those after it begin at its end") {
    Scene scene = squeezed();
    Simulation simulation = started(scene);
    Measurement measurement(scene, simulation);
    while (!measurement.is_complete()) measurement.add(simulation.step(), simulation);
    CHECK(measurement.series().rows() == 4);
    const auto ramped = measurement.summary(simulation);
    CHECK(ramped["equilibrated"] == false);
    CHECK(ramped["equilibrium"]["in_words"] == "not reached: schedule.kT, schedule.volume_fraction until time 0.16");
    CHECK(ramped["Z"]["standard_error"].is_null());
    CHECK(ramped["checks"].empty());
    CHECK(ramped["schedule"]["in_averages"] == true);
    CHECK(ramped["volume_fraction"] == 0.4);
    double kinetic = 0.0;
    for (std::size_t row = 0; row < 4; ++row)
        kinetic += 0.25 * (measurement.series().column("pressure")[row] -
                           measurement.series().column("pressure_collision")[row]);
    CHECK(ramped["stress_kinetic"]["mean"].get<double>() == doctest::Approx(kinetic).epsilon(1e-12));

    scene.time.equilibration.reset();
    Simulation again = started(scene);
    Measurement after(scene, again);
    while (!after.is_complete()) after.add(again.step(), again);
    CHECK(after.series().rows() >= 8);
    const auto summary = after.summary(again);
    CHECK(summary["equilibration_time"].get<double>() >= 0.16 * (1.0 - 1e-12));
    CHECK(summary["schedule"]["in_averages"] == false);
}
