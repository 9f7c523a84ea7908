#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "jostle/error/input_error.hpp"
#include "jostle/scene/scene_keys.hpp"
#include "jostle/scene/validate_scene.hpp"

using namespace jostle;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Scene good_scene() {
    Scene scene;
    scene.box.volume_fraction = 0.2;
    scene.rods.count = 100;
    scene.rods.length = 5.0;
    scene.time.step = 1e-3;
    scene.time.production = 10.0;
    return scene;
}

/// The key that `validate` refuses after a change to the good scene, or "" if it accepts.
std::string refused_key(const std::function<void(Scene&)>& change, std::string* message = nullptr) {
    Scene scene = good_scene();
    change(scene);
    try {
        validate(scene);
    } catch (const InputError& error) {
        CHECK(error.parts().place.line == 0);
        CHECK(!error.parts().problem.empty());
        if (message != nullptr) *message = error.what();
        return error.parts().key;
    }
    return "";
}

/// Gives `value` to the quantity number `index` of a scene; false when there are fewer.
bool set_quantity(Scene& scene, int index, double value, std::string& changed) {
    int number = 0;
    for_each_key(scene, [&]<class Member, class Spec>(std::string_view table, std::string_view name, Member& member,
                                                      const Spec&) {
        if constexpr (std::is_same_v<Spec, Quantity>) {
            if (number++ != index) return;
            changed = full_key(table, name);
            if constexpr (std::is_same_v<Member, Vec3> || std::is_same_v<Member, std::optional<Vec3>>)
                member = Vec3{1.0, value, 1.0};
            else if constexpr (std::is_same_v<Member, Ramp<Vec3>>)
                member = {{1.0, Vec3{1.0, value, 1.0}}};
            else if constexpr (std::is_same_v<Member, Ramp<double>>)
                member = {{1.0, value}};
            else
                member = value;
        }
    });
    return index < number;
}

}  // namespace

TEST_CASE("good scenes pass") {
    CHECK(refused_key([](Scene&) {}) == "");
    CHECK(refused_key([](Scene& s) { s.rods.length = 0.0; }) == "");
    CHECK(refused_key([](Scene& s) { s.fluid.kT = 0.0; }) == "");
    CHECK(refused_key([](Scene& s) { s.motion.brownian = false; }) == "");
    CHECK(refused_key([](Scene& s) { s.mobility.model = MobilityModel::slender_body; }) == "");
    CHECK(refused_key([](Scene& s) { s.time = {std::nullopt, 0.03, std::nullopt, 1.0, 5.0}; }) == "");
    CHECK(refused_key([](Scene& s) { s.seed = std::numeric_limits<std::int64_t>::max(); }) == "");
    CHECK(refused_key([](Scene& s) { s.rods.count = 2147483647; }) == "");
}

TEST_CASE("no quantity may be nan, infinite or out of bounds, whichever key it is") {
    Scene counted = good_scene();
    std::string key;
    int quantities = 0;
    while (set_quantity(counted, quantities, 1.0, key)) ++quantities;
    CHECK(quantities == 52);
    for (int index = 0; index < quantities; ++index)
        for (const double value : {not_a_number, infinity, -infinity, 1e300, -1e300}) {
            std::string changed, message;
            // the start and the box that make the key mean something
            const std::string refused = refused_key(
                [&](Scene& s) {
                    Scene probe = s;
                    set_quantity(probe, index, value, changed);
                    s.motion = {true, 1.0, 0.1, 0.1, 1.0, 0.1};
                    if (changed == "rods.axis") s.rods.start = StartKind::aligned;
                    if (changed == "box.edges") s.box.volume_fraction.reset();
                    if (changed == "time.rms_step" || changed == "time.accuracy") s.time.step.reset();
                    s.output.field_every = 10;
                    if (changed.starts_with("growth.")) {
                        s.growth.rate = 0.1;
                        s.growth.division_length = 2.0 * s.rods.length + s.rods.diameter;
                    }
                    set_quantity(s, index, value, changed);
                },
                &message);
            CAPTURE(message);
            CHECK(refused == changed);
        }
}

TEST_CASE("contact.range is bounded by the longest rod from end to end") {
    std::string message;
    for (const double range : {6.1, 1e12, 1e30})
        CHECK(refused_key(
                  [&](Scene& s) {
                      s.rods.length = 5.0;
                      s.contact.range = range;
                  },
                  &message) == "contact.range");
    CHECK(message.find("the longest measures 6 from end to end (allowed: at most 6)") != std::string::npos);
    const auto cells = [](Scene& s) {
        s.rods.length = 2.0;
        s.growth.rate = 0.1;
        s.growth.division_length = 8.0;
    };
    CHECK(refused_key([&](Scene& s) { cells(s), s.contact.range = 9.0; }) == "");
    CHECK(refused_key([&](Scene& s) { cells(s), s.contact.range = 9.1; }) == "contact.range");
    CHECK(refused_key([&](Scene& s) { s.rods.length = 0.0, s.contact.range = 1.0; }) == "");
}

TEST_CASE("ranges") {
    CHECK(refused_key([](Scene& s) { s.seed = ~std::uint64_t{0}; }) == "seed");
    CHECK(refused_key([](Scene& s) { s.rods.count = 0; }) == "rods.count");
    CHECK(refused_key([](Scene& s) { s.rods.count = ~std::uint64_t{0}; }) == "rods.count");
    CHECK(refused_key([](Scene& s) { s.rods.diameter = 0.0; }) == "rods.diameter");
    // Their squares would overflow in float, and contacts be missed.
    CHECK(refused_key([](Scene& s) { s.rods.diameter = 1e19; }) == "rods.diameter");
    CHECK(refused_key([](Scene& s) { s.rods.diameter = 1e-19; }) == "rods.diameter");
    CHECK(refused_key([](Scene& s) { s.rods.length = 1e19; }) == "rods.length");
    CHECK(refused_key([](Scene& s) { s.fluid.viscosity = -1.0; }) == "fluid.viscosity");
    CHECK(refused_key([](Scene& s) { s.solver.tolerance = 0.1; }) == "solver.tolerance");
    CHECK(refused_key([](Scene& s) { s.solver.max_iterations = 0; }) == "solver.max_iterations");
    CHECK(refused_key([](Scene& s) { s.output.series_every = 0; }) == "output.series_every");
    CHECK(refused_key([](Scene& s) { s.output.checkpoint_every = 0; }) == "output.checkpoint_every");
    CHECK(refused_key([](Scene& s) { s.time.production = 0.0; }) == "time.production");
    CHECK(refused_key([](Scene& s) { s.contact.overlap_limit = 1e-6; }) == "contact.overlap_limit");
}

TEST_CASE("keys beside keys") {
    CHECK(refused_key([](Scene& s) { s.box.edges = Vec3{20, 20, 20}; }) == "box.edges");
    CHECK(refused_key([](Scene& s) { s.box.volume_fraction.reset(); }) == "box.volume_fraction");
    CHECK(refused_key([](Scene& s) { s.time.rms_step = 0.03; }) == "time.rms_step");
    CHECK(refused_key([](Scene& s) { s.time.step.reset(); }) == "");
    CHECK(refused_key([](Scene& s) { s.time.step.reset(), s.motion.brownian = false; }) == "time.step");
    CHECK(refused_key([](Scene& s) { s.time.step.reset(), s.fluid.kT = 0.0; }) == "time.step");
    CHECK(refused_key([](Scene& s) { s.rods.file = "rods.csv"; }) == "rods.file");
    CHECK(refused_key([](Scene& s) { s.output.stress_per_rod = true; }) == "");
    CHECK(refused_key([](Scene& s) {
              s.output.trajectory_every = 0;
              s.output.stress_per_rod = true;
          }) == "output.stress_per_rod");
    CHECK(refused_key([](Scene& s) { s.output.field_spacing = 2.0; }) == "output.field_spacing");
    CHECK(refused_key([](Scene& s) { s.springs.file = "springs.csv"; }) == "");
    CHECK(refused_key([](Scene& s) {
              s.springs.file = "springs.csv";
              s.growth.rate = 0.1;
              s.growth.division_length = 12.0;
          }) == "springs.file");
    CHECK(refused_key([](Scene& s) { s.forces.on_rods = {0, 0, -1}; }) == "forces.on_rods");
    CHECK(refused_key([](Scene& s) { s.forces.on_rods = {0, 0, -1}, s.forces.drift = true; }) == "");
    CHECK(refused_key([](Scene& s) { s.pressure.external = 1.0; }) == "");
    CHECK(refused_key([](Scene& s) { s.pressure.external = 1.0, s.fluid.kT = 0.0; }) == "");
    for (const auto& change :
         std::vector<std::function<void(Scene&)>>{[](Scene& s) {
                                                      s.schedule.kT = {{1.0, 2.0}};
                                                  },
                                                  [](Scene& s) { s.motion.self_propulsion = 0.1; },
                                                  [](Scene& s) {
                                                      s.box.periodic = {true, true, false};
                                                  },
                                                  [](Scene& s) { s.rods.fixed = "fixed.csv"; },
                                                  [](Scene& s) { s.mobility.model = MobilityModel::hydrodynamic; },
                                                  [](Scene& s) { s.contact.model = ContactModel::wca; },
                                                  [](Scene& s) { s.contact.brownian_correction = false; },
                                                  [](Scene& s) {
                                                      s.schedule.volume_fraction = {{1.0, 0.2}};
                                                  }})
        CHECK(refused_key([&](Scene& s) {
                  s.pressure.external = 1.0;
                  change(s);
              }) == "pressure.external");
    CHECK(refused_key([](Scene& s) {
              s.pressure.external = 1.0;
              s.pressure.coupling = StrainCoupling::orthogonal;
              s.springs.file = "springs.csv";
          }) == "pressure.coupling");
    CHECK(refused_key([](Scene& s) { s.forces.drift = true; }) == "forces.drift");
    CHECK(refused_key([](Scene& s) { s.flow.shear_rate = 1.0, s.flow.strain_amplitude = 0.1; }) ==
          "flow.strain_amplitude");
    CHECK(refused_key([](Scene& s) { s.flow.strain_amplitude = 0.1; }) == "flow.frequency");
    CHECK(refused_key([](Scene& s) { s.flow.frequency = 0.1; }) == "flow.frequency");
    CHECK(refused_key([](Scene& s) { s.flow.shear_rate = 1e-3, s.box.periodic[1] = false; }) == "box.periodic");
    CHECK(refused_key([](Scene& s) { s.forces.alignment_energy = 1.0; }) == "");
    CHECK(refused_key([](Scene& s) { s.forces.alignment_axis = {1, 0, 0}; }) == "forces.alignment_axis");
    CHECK(refused_key([](Scene& s) {
              s.forces.alignment_energy = 1.0;
              s.forces.alignment_axis = {0, 0, 0};
          }) == "forces.alignment_axis");
    CHECK(refused_key([](Scene& s) { s.rods.axis = {0, 1, 0}; }) == "rods.axis");
    CHECK(refused_key([](Scene& s) { s.rods.start = StartKind::file; }) == "rods.file");
    CHECK(refused_key([](Scene& s) {
              s.rods.start = StartKind::file;
              s.rods.file = "rods.csv";
              s.rods.count = 0;
          }) == "");
    CHECK(refused_key([](Scene& s) {
              s.rods.start = StartKind::aligned;
              s.rods.axis = {0, 0, 0};
          }) == "rods.axis");
    const auto rms = [](Scene& s) { s.time.step.reset(), s.time.rms_step = 0.03; };
    CHECK(refused_key([&](Scene& s) { rms(s), s.fluid.kT = 0.0; }) == "time.rms_step");
    CHECK(refused_key([&](Scene& s) { rms(s), s.motion.brownian = false; }) == "time.rms_step");
}

TEST_CASE("time.accuracy is for scenes whose error at a finite step is known, and instead of a step") {
    const auto accurate = [](Scene& s) { s.time.step.reset(), s.time.accuracy = 0.01; };
    CHECK(refused_key([&](Scene& s) { accurate(s); }) == "");
    CHECK(refused_key([&](Scene& s) { accurate(s), s.time.step = 0.01; }) == "time.accuracy");
    CHECK(refused_key([&](Scene& s) { accurate(s), s.time.rms_step = 0.01; }) == "time.accuracy");
    CHECK(refused_key([&](Scene& s) { accurate(s), s.time.accuracy = 0.2; }) == "time.accuracy");
    CHECK(refused_key([&](Scene& s) { accurate(s), s.motion.self_propulsion = 1.0; }) == "time.accuracy");
    CHECK(refused_key([&](Scene& s) { accurate(s), s.contact.brownian_correction = false; }) == "time.accuracy");
    CHECK(refused_key([&](Scene& s) { accurate(s), s.mobility.model = MobilityModel::hydrodynamic; }) ==
          "time.accuracy");
}

TEST_CASE("keys of swimmers") {
    const auto swim = [](Scene& s) { s.motion.self_propulsion = 1.0; };
    CHECK(refused_key([&](Scene& s) { swim(s), s.motion.self_propulsion_deviation = 0.5; }) == "");
    CHECK(refused_key([&](Scene& s) { swim(s), s.motion.tumble_rate = 2.0; }) == "");
    CHECK(refused_key([&](Scene& s) { swim(s), s.motion.reversal_rate = 2.0; }) == "");
    CHECK(refused_key([&](Scene& s) { swim(s), s.output.active_stress_lag = 2.0; }) == "");
    CHECK(refused_key([&](Scene& s) { swim(s), s.motion.self_propulsion_deviation = -0.5; }) ==
          "motion.self_propulsion_deviation");
    CHECK(refused_key([&](Scene& s) { swim(s), s.motion.tumble_rate = -2.0; }) == "motion.tumble_rate");
    CHECK(refused_key([&](Scene& s) { swim(s), s.motion.reversal_rate = not_a_number; }) == "motion.reversal_rate");
    CHECK(refused_key([&](Scene& s) { swim(s), s.motion.tumble_rate = 2.0, s.motion.tumble_time = 0.0; }) ==
          "motion.tumble_time");
    CHECK(refused_key([&](Scene& s) { swim(s), s.motion.tumble_rate = 2.0, s.motion.tumble_time = 5.1; }) ==
          "motion.tumble_time");
    CHECK(refused_key([&](Scene& s) { swim(s), s.motion.tumble_rate = 2.0, s.motion.tumble_time = 0.03; }) ==
          "motion.tumble_time");  // 31 steps: a turn of pi moves the ends of a rod L/D = 5 by up to 0.25 D a step
    CHECK(refused_key([&](Scene& s) { swim(s), s.motion.tumble_time = 1.0; }) == "motion.tumble_time");
    CHECK(refused_key([](Scene& s) { s.motion.self_propulsion_deviation = 0.5; }) ==
          "motion.self_propulsion_deviation");
    CHECK(refused_key([](Scene& s) { s.motion.tumble_rate = 2.0; }) == "motion.tumble_rate");
    CHECK(refused_key([](Scene& s) { s.motion.tumble_time = 2.0; }) == "motion.tumble_time");
    CHECK(refused_key([](Scene& s) { s.motion.reversal_rate = 2.0; }) == "motion.reversal_rate");
    CHECK(refused_key([](Scene& s) { s.output.active_stress_lag = 2.0; }) == "output.active_stress_lag");
}

TEST_CASE("times") {
    CHECK(refused_key([](Scene& s) { s.time.production = 1e-3; }) == "");
    CHECK(refused_key([](Scene& s) { s.time.production = 0.999e-3; }) == "time.production");
    CHECK(refused_key([](Scene& s) { s.time.production = 1e20; }) == "time.production");
    CHECK(refused_key([](Scene& s) { s.time.equilibration = 1e20; }) == "time.equilibration");
}

TEST_CASE("slender body: refused up to L/D = sqrt(e)/2") {
    const auto with = [](double length) {
        return [length](Scene& s) {
            s.rods.length = length * 3.0;
            s.rods.diameter = 3.0;
            s.mobility.model = MobilityModel::slender_body;
        };
    };
    CHECK(refused_key(with(0.8243)) == "mobility.model");
    CHECK(refused_key(with(0.8245)) == "");
    CHECK(refused_key(with(0.0)) == "mobility.model");
}

TEST_CASE("rods that cannot be packed, or not at random") {
    const auto dense = [](StartKind start, double fraction, double length) {
        return refused_key([=](Scene& s) {
            s.rods.start = start;
            s.rods.length = length;
            s.box.volume_fraction = fraction;
        });
    };
    CHECK(dense(StartKind::lattice, 0.7404, 0.0) == "");
    CHECK(dense(StartKind::lattice, 0.7405, 0.0) == "box.volume_fraction");
    CHECK(dense(StartKind::aligned, 0.883, 5.0) == "");
    CHECK(dense(StartKind::aligned, 0.884, 5.0) == "box.volume_fraction");
    CHECK(dense(StartKind::random, 0.60, 0.0) == "");
    CHECK(dense(StartKind::random, 0.61, 0.0) == "box.volume_fraction");
    CHECK(dense(StartKind::random, 0.45, 5.0) == "");
    CHECK(dense(StartKind::random, 0.46, 5.0) == "box.volume_fraction");
    CHECK(dense(StartKind::random, 0.10, 40.0) == "");
    CHECK(dense(StartKind::random, 0.12, 40.0) == "box.volume_fraction");
    // four spheres in the cube of the face-centred lattice, close-packed to rounding
    CHECK(refused_key([](Scene& s) {
              s.rods = {.count = 4, .start = StartKind::lattice, .file = ""};
              s.box.volume_fraction.reset();
              s.box.edges = Vec3{std::sqrt(2.0), std::sqrt(2.0), std::sqrt(2.0)};
          }) == "");
}

TEST_CASE("a box thinner than a rod's diameter") {
    std::string message;
    CHECK(refused_key(
              [](Scene& s) {
                  s.box.volume_fraction.reset();
                  s.box.edges = Vec3{100, 100, 0.99};
              },
              &message) == "box.edges");
    CHECK(message.find("edge z is 0.99") != std::string::npos);
    CHECK(refused_key(
              [](Scene& s) {
                  s.rods.count = 2;
                  s.box.shape = {30, 1, 30};
              },
              &message) == "box.volume_fraction");
    CHECK(message.find("edge y is") != std::string::npos);
    CHECK(refused_key([](Scene& s) {
              s.box.volume_fraction.reset();
              s.box.edges = Vec3{100, 100, 1.0};
          }) == "");
}

TEST_CASE("the box of rods from a file is checked once their volume is known") {
    Scene scene = good_scene();
    scene.rods.start = StartKind::file;
    scene.rods.file = "rods.csv";
    scene.rods.count = 0;
    scene.box.volume_fraction.reset();
    scene.box.edges = Vec3{10, 10, 10};
    validate(scene);
    validate_box(scene, 999.0, 2.0);
    CHECK_THROWS_AS(validate_box(scene, 1000.0, 2.0), InputError);
    CHECK_THROWS_AS(validate_box(scene, 10.0, 10.1), InputError);
}
