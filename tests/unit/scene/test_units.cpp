#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "jostle/error/input_error.hpp"
#include "jostle/scene/units.hpp"

using namespace jostle;

namespace {

std::string refusal(const std::string& text, Dimension expected) {
    try {
        parse_quantity(text, expected);
    } catch (const InputError& error) {
        CHECK(error.parts().value.find('"') == 0);
        CHECK(!error.parts().allowed.empty());
        CHECK(!error.parts().suggestion.empty());
        return error.parts().problem;
    }
    return "";
}

}  // namespace

TEST_CASE("quantities in the micro system, to the last bit") {
    struct Row {
        std::string text;
        Dimension expected;
        double value;
    };
    const std::vector<Row> rows = {
        {"300 nm", dimension::length, 0.3},
        {"0.7mm", dimension::length, 700.0},
        {"1e-6 m", dimension::length, 1.0},
        {"2 um/s", dimension::speed, 2.0},
        {"+2 um s-1", dimension::speed, 2.0},
        {"2 um*s^-1", dimension::speed, 2.0},
        {"120 um / min", dimension::speed, 2.0},
        {"3.6 mm/h", dimension::speed, 1.0},
        {"35.1 s", dimension::time, 35.1},
        {"0.1 ms", dimension::time, 1e-4},
        {"2 h", dimension::time, 7200.0},
        {"1e-3 pN s/um^2", dimension::viscosity, 1e-3},
        {"1e-3 Pa s", dimension::viscosity, 1e-3},
        {"1 mPa*s", dimension::viscosity, 1e-3},
        {"1 cP", dimension::viscosity, 1e-3},
        {"0.01 P", dimension::viscosity, 1e-3},
        {"1e-3 N s m^-2", dimension::viscosity, 1e-3},
        {"0.00411 pN um", dimension::energy, 0.00411},
        {"4.11 zJ", dimension::energy, 0.00411},
        {"4.11 pN nm", dimension::energy, 0.00411},
        {"1 kPa", dimension::stress, 1000.0},
        {"1 N / m / m", dimension::stress, 1.0},
        {"5 \u00b5m", dimension::length, 5.0},
        {"5 \u03bcm", dimension::length, 5.0},
        {"-2 um", dimension::length, -2.0},
    };
    for (const Row& row : rows) {
        CAPTURE(row.text);
        CHECK(parse_quantity(row.text, row.expected) == row.value);
    }
    CHECK(parse_quantity("4.11e-21 J", dimension::energy) == doctest::Approx(0.00411).epsilon(1e-15));
}

TEST_CASE("what is no quantity is refused") {
    CHECK(refusal("3", dimension::length) == "has no unit");
    CHECK(refusal("", dimension::length) == "does not begin with a number");
    CHECK(refusal("um", dimension::length) == "does not begin with a number");
    CHECK(refusal("3 s", dimension::length) == "is a quantity in s");
    CHECK(refusal("3 um/um", dimension::length) == "is a quantity in pure numbers");
    CHECK(refusal("3 Pa", dimension::viscosity) == "is a quantity in pN/um2");
    CHECK(refusal("3 parsec", dimension::length) == "has the unknown unit \"parsec\"");
    CHECK(refusal("3 um/", dimension::length) == "ends with \"/\"");
    CHECK(refusal("3 um *", dimension::length) == "ends with \"*\"");
    CHECK(refusal("3 um // s", dimension::speed) == "cannot be read from \"/ s\" on");
    CHECK(refusal("3 um^", dimension::length).find("power") != std::string::npos);
    CHECK(refusal("3 um^x", dimension::length).find("power") != std::string::npos);
    CHECK(refusal("3 um^99999999999", dimension::length).find("power") != std::string::npos);
    CHECK(refusal("3 (um)", dimension::length) == "cannot be read from \"(um)\" on");
    CHECK(refusal("1e999 um", dimension::length) == "is not a finite number");
    CHECK(refusal("nan um", dimension::length) == "is not a finite number");
    CHECK(refusal("inf um", dimension::length) == "is not a finite number");
    CHECK(refusal("3,5 um", dimension::length) == "cannot be read from \",5 um\" on");
}

TEST_CASE("names of units for outputs") {
    Scene scene;
    scene.units.system = UnitSystem::micro;
    CHECK(unit_of(scene, dimension::stress) == "pN um-2");
    CHECK(unit_of(scene, dimension::viscosity) == "pN um-2 s");
    CHECK(unit_of(scene, dimension::energy) == "pN um");
    CHECK(unit_of(scene, dimension::speed) == "um s-1");
    CHECK(unit_of(scene, dimension::number_density) == "um-3");
    CHECK(unit_of(scene, dimension::none) == "");
    scene.units.system = UnitSystem::reduced;
    CHECK(unit_of(scene, dimension::length) == "D");
    CHECK(unit_of(scene, dimension::energy) == "kT");
    CHECK(unit_of(scene, dimension::viscosity) == "mu");
    CHECK(unit_of(scene, dimension::stress) == "kT D-3");
    CHECK(unit_of(scene, dimension::force) == "kT D-1");
    CHECK(unit_of(scene, dimension::time) == "kT-1 D3 mu");
    CHECK(unit_of(scene, dimension::speed) == "kT D-2 mu-1");
    CHECK(unit_of(scene, dimension::none) == "");
    scene.fluid.kT = 0.01;
    CHECK(unit_of(scene, dimension::stress) == "mu time_unit-1");
    CHECK(unit_of(scene, dimension::time) == "time_unit");
    CHECK(unit_of(scene, dimension::energy) == "D3 mu time_unit-1");
    CHECK(unit_of(scene, dimension::force) == "D2 mu time_unit-1");
    CHECK(unit_of(scene, dimension::viscosity) == "mu");
    scene.rods.diameter = 2.0;
    CHECK(unit_of(scene, dimension::number_density) == "length_unit-3");
    scene.fluid.viscosity = 3.0;
    CHECK(unit_of(scene, dimension::time) == "time_unit");
    CHECK(unit_of(scene, dimension::stress) == "viscosity_unit time_unit-1");
}

TEST_CASE("people read quotients") {
    CHECK(readable_unit("kT-1 D3 mu") == "mu D3/kT");
    CHECK(readable_unit("kT D-3") == "kT/D3");
    CHECK(readable_unit("kT D-2 mu-1") == "kT/(mu D2)");
    CHECK(readable_unit("um s-1") == "um/s");
    CHECK(readable_unit("s-1") == "1/s");
    CHECK(readable_unit("D") == "D");
    CHECK(readable_unit("") == "");
}

TEST_CASE("times of cells are those in which they lengthen by D") {
    Scene scene;
    scene.fluid.kT = 0.0;
    const auto [no_growth, name] = readable_unit(scene, "mu time_unit-1");
    CHECK(no_growth == 1.0);
    CHECK(name == "mu/time_unit");
    scene.growth.rate = 4.0;  // D in a quarter of the unit of time
    const ReadableUnit time = readable_unit(scene, "time_unit"), stress = readable_unit(scene, "mu time_unit-1");
    CHECK(time.factor == 4.0);
    CHECK(time.name == "D/growth rate");
    CHECK(stress.factor == 0.25);
    CHECK(stress.name == "mu growth rate/D");
    CHECK(readable_unit(scene, "D2 time_unit-1").name == "D growth rate");
    CHECK(readable_unit(scene, "kT-1 D3 mu").name == "mu D3/kT");
}

TEST_CASE("every example and every micro unit reads back in its own dimension") {
    for (const Dimension d :
         {dimension::length, dimension::time, dimension::force, dimension::volume, dimension::speed, dimension::rate,
          dimension::number_density, dimension::energy, dimension::stress, dimension::viscosity}) {
        CHECK(parse_quantity("3 " + micro_unit_of(d), d) == 3.0);
        CHECK(parse_quantity(example_quantity(d), d) > 0.0);
    }
}
