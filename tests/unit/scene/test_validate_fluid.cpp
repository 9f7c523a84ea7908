#include <doctest/doctest.h>

#include <functional>

#include "jostle/error/input_error.hpp"
#include "jostle/scene/validate_scene.hpp"

using namespace jostle;

namespace {

std::string refused_key(const std::function<void(Scene&)>& change) {
    Scene scene;
    scene.box.volume_fraction = 0.1;
    scene.rods.count = 100;
    scene.rods.length = 5.0;
    scene.mobility.model = MobilityModel::hydrodynamic;
    scene.time.production = 10.0;
    change(scene);
    try {
        validate(scene);
    } catch (const InputError& error) {
        return error.parts().key;
    }
    return "";
}

}  // namespace

TEST_CASE("with a fluid, what is known passes") {
    CHECK(refused_key([](Scene&) {}) == "");
    CHECK(refused_key([](Scene& s) { s.rods.length = 0.0; }) == "");
    CHECK(refused_key([](Scene& s) { s.rods.length = 20.0; }) == "");
    CHECK(refused_key([](Scene& s) { s.rods.length_deviation = 0.5; }) == "");
    CHECK(refused_key([](Scene& s) { s.box.periodic = {false, false, false}; }) == "");
    CHECK(refused_key([](Scene& s) { s.mobility.tolerance = 1e-6; }) == "");
    CHECK(refused_key([](Scene& s) { s.mobility.cutoff = 3.0; }) == "");
    CHECK(refused_key([](Scene& s) { s.solver.method = SolverMethod::bbpgd; }) == "");
    CHECK(refused_key([](Scene& s) { s.solver.tolerance = 1e-8; }) == "");
    for (const double length : {5.0, 0.0})
        for (const double dipole : {0.0, 2.0, -2.0})
            CHECK(refused_key([&](Scene& s) {
                      s.rods.length = length;
                      s.motion.self_propulsion = 1.0;
                      s.motion.force_dipole = dipole;
                  }) == "");
}

TEST_CASE("with a fluid, what is not known is refused, one line each") {
    CHECK(refused_key([](Scene& s) { s.rods.length = 20.5; }) == "rods.length");
    CHECK(refused_key([](Scene& s) { s.rods.diameter_deviation = 0.05; }) == "rods.diameter_deviation");
    CHECK(refused_key([](Scene& s) { s.box.periodic = {true, true, false}; }) == "box.periodic");
    CHECK(refused_key([](Scene& s) {
              s.box.periodic = {false, false, false};
              s.rods.count = 2001;
          }) == "rods.count");
    CHECK(refused_key([](Scene& s) { s.mobility.cutoff = 0.9; }) == "mobility.cutoff");
    CHECK(refused_key([](Scene& s) { s.mobility.cutoff = 20.5; }) == "mobility.cutoff");
    CHECK(refused_key([](Scene& s) { s.solver.tolerance = 0.9e-8; }) == "solver.tolerance");
    CHECK(refused_key([](Scene& s) {
              s.solver.tolerance = 0.9e-8;
              s.box.periodic = {false, false, false};
          }) == "solver.tolerance");
    CHECK(refused_key([](Scene& s) { s.mobility.tolerance = 1e-7; }) == "mobility.tolerance");
    CHECK(refused_key([](Scene& s) { s.motion.force_dipole = 0.1; }) == "motion.force_dipole");  // nothing swims
    CHECK(refused_key([](Scene& s) { s.schedule.kT.push_back({5.0, 2.0}); }) == "schedule.kT");
    CHECK(refused_key([](Scene& s) { s.springs.file = "springs.csv"; }) == "springs.file");
    CHECK(refused_key([](Scene& s) { s.contact.model = ContactModel::wca; }) == "contact.model");
    CHECK(refused_key([](Scene& s) { s.solver.method = SolverMethod::projected_sor; }) == "solver.method");
    CHECK(refused_key([](Scene& s) {
              s.growth.rate = 0.01;
              s.growth.division_length = 12.0;
          }) == "growth.rate");
}

TEST_CASE("keys of the fluid are not used without it") {
    for (const double length : {5.0, 0.0})
        CHECK(refused_key([&](Scene& s) {
                  s.rods.length = length;
                  s.mobility.model = MobilityModel::capsule;
                  s.motion.self_propulsion = 1.0;
                  s.motion.force_dipole = 1.0;
              }) == "motion.force_dipole");
    CHECK(refused_key([](Scene& s) {
              s.mobility.model = MobilityModel::capsule;
              s.mobility.tolerance = 1e-4;
          }) == "mobility.tolerance");
    CHECK(refused_key([](Scene& s) {
              s.mobility.model = MobilityModel::capsule;
              s.mobility.cutoff = 3.0;
          }) == "mobility.cutoff");
}
