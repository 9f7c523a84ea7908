#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "jostle/error/input_error.hpp"
#include "jostle/measurement/measurement.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"

using namespace jostle;

namespace {

Scene some_scene() {
    Scene scene;
    scene.box.volume_fraction = 0.25;
    scene.rods.count = 40;
    scene.rods.length = 1.0;
    scene.time.step = 0.01;
    scene.time.equilibration = 0.2;
    scene.time.production = 0.6;
    scene.output.series_every = 5;
    scene.output.field_every = 30;
    return scene;
}

Simulation begun(const Scene& scene) {
    const Box box{box_edges(scene, rods_volume(scene)), scene.box.periodic};
    return assemble(scene, {box, make_start(scene, box)});
}

}  // namespace

TEST_CASE("a measurement has the rows, the fields and the averages of its run") {
    const Scene scene = some_scene();
    Simulation simulation = begun(scene);
    Measurement measurement(scene, simulation);
    CHECK_THROWS_AS(measurement.summary(simulation), InputError);  // no row
    double collisions = 0.0, steps = 0.0;
    while (!measurement.is_complete()) {
        const StepReport report = simulation.step();
        const Due due = measurement.add(report, simulation);
        collisions += trace(report.collision_virial) / 3.0 / simulation.box().volume();
        steps += 1.0;
        CHECK(due.row == (simulation.clock().step % 5 == 0));
        if (due.row) {
            const std::vector<double> row = measurement.last_row();
            CHECK(row[0] == static_cast<double>(simulation.clock().step));
            CHECK(measurement.series().column("pressure_collision").back() ==
                  doctest::Approx(collisions / steps).epsilon(1e-12));
            collisions = steps = 0.0;
        }
        if (simulation.clock().step == 20)  // equilibration has just ended
            CHECK_THROWS_AS(measurement.summary(simulation), InputError);
        if (due.field) CHECK(measurement.last_field().front()[0] == static_cast<double>(simulation.clock().step));
    }
    CHECK(measurement.series().rows() == 16);
    CHECK(measurement.fraction_done() == 1.0);
    const auto summary = measurement.summary(simulation);
    CHECK(summary["production_rows"] == 12);
    double mean = 0.0;
    for (std::size_t row = 4; row < 16; ++row) mean += measurement.series().column("Z")[row] / 12.0;
    CHECK(summary["Z"]["mean"].get<double>() == doctest::Approx(mean).epsilon(1e-12));
}

TEST_CASE("a measurement that is stopped and goes on comes to the same") {
    const Scene scene = some_scene();
    Simulation whole = begun(scene), halves = begun(scene);
    Measurement of_whole(scene, whole), first(scene, halves);
    for (int k = 0; k < 80; ++k) of_whole.add(whole.step(), whole);
    for (int k = 0; k < 38; ++k) first.add(halves.step(), halves);  // within a row, and within a field
    Measurement second(scene, halves, StepSums::from_named(first.sums().to_named(), scene, halves.box()),
                       first.series());
    for (int k = 38; k < 80; ++k) second.add(halves.step(), halves);
    CHECK(second.summary(halves) == of_whole.summary(whole));
    CHECK(second.last_field() == of_whole.last_field());
    CHECK(second.is_complete());
}

TEST_CASE("a measurement that goes on without the earlier rows knows when they ended") {
    const Scene scene = some_scene();
    Simulation simulation = begun(scene);
    Measurement first(scene, simulation);
    for (int k = 0; k < 38; ++k) first.add(simulation.step(), simulation);
    Measurement second(scene, simulation, StepSums::from_named(first.sums().to_named(), scene, simulation.box()));
    CHECK(second.series().rows() == 0);
    int steps = 0;
    for (; !second.is_complete(); ++steps) second.add(simulation.step(), simulation);
    CHECK(steps == 42);
    CHECK(second.summary(simulation)["production_rows"] == 9);  // those of the steps 40, 45, ... 80
}

TEST_CASE("steps that did not converge are not measured") {
    const Scene scene = some_scene();
    Simulation simulation = begun(scene);
    Measurement measurement(scene, simulation);
    StepReport report = simulation.step();
    report.status = LcpStatus::iteration_limit;
    CHECK_THROWS_AS(measurement.add(report, simulation), std::logic_error);
}

TEST_CASE("tables: every column has a name of its own, a unit, a definition, and a value in every row") {
    Scene scene = some_scene();
    scene.output.stress_conventions = true;
    Simulation simulation = begun(scene);
    Measurement measurement(scene, simulation);
    for (int k = 0; k < 30; ++k) measurement.add(simulation.step(), simulation);
    const auto check = [](const std::vector<SeriesColumn>& columns) {
        std::set<std::string> names;
        for (const SeriesColumn& column : columns) {
            CHECK(names.insert(column.name).second);
            CHECK(!column.unit.empty());
            CHECK(!column.definition.empty());
        }
    };
    check(series_columns(scene).about());
    check(contact_columns(scene).about());
    check(lineage_columns(scene).about());
    check(field_columns(scene).about());
    for (const double value : measurement.last_row()) CHECK(std::isfinite(value));
    const TableRows contacts = contact_rows(contact_columns(scene), simulation);
    REQUIRE(!contacts.empty());
    for (const auto& row : contacts) {
        CHECK(row[1] < row[2]);                                                             // ids
        CHECK(std::hypot(row[8], row[9], row[10]) == doctest::Approx(1.0).epsilon(1e-12));  // normal
        CHECK(row[6] > 0.0);
    }
}
