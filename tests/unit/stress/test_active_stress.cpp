#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "jostle/error/input_error.hpp"
#include "jostle/stress/active_stress.hpp"

using namespace jostle;

namespace {

const Box box{{10, 20, 30}, {true, true, true}};

/// Two rods that move by (1, 0, 0) and (0, 2, 0) a look, through the faces of the box.
Rods rods_at(int look) {
    Rods rods;
    rods.push_back(1, {9.5 + look, 5, 5}, {1, 0, 0}, 5.0, 1.0);
    rods.push_back(0, {5, 15.0 + 2 * look, 5}, {0, 1, 0}, 5.0, 1.0);
    for (std::size_t i = 0; i < 2; ++i) box.wrap(rods.centre[i], rods.image[i]);
    return rods;
}

const std::vector<Vec3> force = {{3, 1, 0}, {0, 0, 4}};

}  // namespace

TEST_CASE("x F with unwrapped x, first index that of x, from positions of one to two lags ago") {
    constexpr int lag = 4;
    ActiveStress stress(lag);
    stress.begin(rods_at(0), box);
    for (int look = 1; look < 40; ++look) {
        CAPTURE(look);
        const Mat3 virial = stress.virial(rods_at(look), box, force);
        if (look < lag) {
            CHECK(std::isnan(virial(0, 0)));
            continue;
        }
        const double age = lag + look % lag;
        CHECK(virial(0, 0) == doctest::Approx(3.0 * age));
        CHECK(virial(0, 1) == doctest::Approx(1.0 * age));
        CHECK(virial(1, 2) == doctest::Approx(8.0 * age));
        CHECK(virial(1, 0) == 0.0);
        CHECK(virial(2, 1) == 0.0);
        if (look % 3 == 0) stress = ActiveStress::from_named(stress.to_named());
    }
}

TEST_CASE("a rod that comes later counts from where it was first seen; one that goes does not count") {
    ActiveStress stress(2);
    stress.begin(rods_at(0), box);
    Rods three = rods_at(1);
    three.push_back(7, {1, 1, 1}, {0, 0, 1}, 5.0, 1.0);
    const std::vector<Vec3> forces = {{0, 0, 0}, {0, 0, 0}, {0, 0, 5}};
    stress.virial(three, box, forces);
    three.centre[2].z = 2.5;
    CHECK(stress.virial(three, box, forces)(2, 2) == doctest::Approx(5.0 * 1.5));
    CHECK(stress.virial(rods_at(3), box, force)(0, 0) == doctest::Approx(3.0 * 3.0));
}

TEST_CASE("daughters go on with their mother's path, and how their centres part from hers is none of it") {
    ActiveStress stress(2);
    Rods rods;
    rods.push_back(0, {1, 1, 1}, {1, 0, 0}, 6.0, 1.0);
    rods.push_back(1, {5, 5, 5}, {1, 0, 0}, 6.0, 1.0);
    stress.begin(rods, box);
    const std::vector<Vec3> forces = {{2, 0, 0}, {0, 3, 0}, {0, 0, 4}};
    for (int look = 1; look <= 12; ++look) {
        for (std::size_t i = 0; i < rods.size(); ++i) {  // a step of (1, 1, 1)/8 for all
            rods.centre[i] += Vec3{0.125, 0.125, 0.125};
            box.wrap(rods.centre[i], rods.image[i]);
        }
        if (look == 5) {  // 1.75 = (6 + 1)/4 to both sides
            const Vec3 mother = rods.centre[1];
            const Image image = rods.image[1];
            rods.centre[1] = mother - Vec3{1.75, 0, 0};
            rods.push_back(9, mother + Vec3{1.75, 0, 0}, {1, 0, 0}, 2.5, 1.0);
            rods.image[2] = image;
            for (const std::size_t i : {1, 2}) box.wrap(rods.centre[i], rods.image[i]);
            const std::vector<ActiveStress::Division> divisions = {{1, 9}};
            stress.divide(rods, box, divisions);
        }
        const Mat3 virial = stress.virial(rods, box, std::span(forces).first(rods.size()));
        if (look < 2) continue;
        const double come =
            0.125 * (look < 4 ? look : 2 + look % 2);  // looks of the path, as of a rod that stays whole
        CHECK(virial(0, 0) == doctest::Approx(2.0 * come));
        CHECK(virial(1, 1) == doctest::Approx(3.0 * come));
        CHECK(virial(2, 2) == doctest::Approx(look < 5 ? 0.0 : 4.0 * come));
    }
}

TEST_CASE("no lag, and numbers that are not whole, are refused") {
    CHECK_THROWS_AS(ActiveStress(0), InputError);
    const NamedNumbers whole = {
        {"lag", {2.0}}, {"looks", {3.0}}, {"id", {4.0}}, {"newer", {0.0, 0.0, 0.0}}, {"older", {0.0, 0.0, 0.0}}};
    CHECK_NOTHROW(ActiveStress::from_named(whole));
    for (const auto& [name, values] : whole) {
        NamedNumbers numbers = whole;
        numbers.erase(name);
        CHECK_THROWS_AS(ActiveStress::from_named(numbers), InputError);
        numbers[name] = {-1.0};
        CHECK_THROWS_AS(ActiveStress::from_named(numbers), InputError);
    }
}
