#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "jostle/error/input_error.hpp"
#include "jostle/mobility/drag.hpp"

using namespace jostle;
using std::numbers::pi;

namespace {

template <class Call>
std::string refused_key(Call&& call) {
    try {
        call();
    } catch (const InputError& error) {
        return error.parts().key;
    }
    return "";
}

/// The published fits without the joining terms: the brackets of finite_aspect_ratio_drag at total length over diameter
/// p.
RodMobility published_brackets(double p) {
    return {std::log(p) - 0.207 + 0.980 / p - 0.133 / (p * p), std::log(p) + 0.839 + 0.185 / p + 0.233 / (p * p),
            std::log(p) - 0.662 + 0.917 / p - 0.050 / (p * p)};
}

RodMobility brackets(double p) {
    const RodMobility mobility = finite_aspect_ratio_drag(p - 1.0, 1.0, 1.0);
    return {mobility.parallel * 2.0 * pi * p, mobility.perpendicular * 4.0 * pi * p,
            mobility.rotational * pi * p * p * p / 3.0};
}

struct SolvedCapsule {
    double length = 0.0;
    RodMobility mobility;
};

/// Solutions of the Stokes equations for single spherocylinders, D = mu = 1 (studies/reference/capsule_mobility.py).
std::vector<SolvedCapsule> solved_capsules() {
    std::ifstream file(JOSTLE_TEST_SOURCES "/../studies/reference/capsule_mobility.csv");
    std::vector<SolvedCapsule> capsules;
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        std::istringstream fields(line);
        std::array<double, 4> value{};
        char comma = 0;
        for (double& one : value) fields >> one >> comma;
        capsules.push_back({value[0], {value[1], value[2], value[3]}});
    }
    return capsules;
}

/// Whether mobilities are positive, fall with the length, and are larger along the axis than across it, by less than 2.
void check_order(RodMobility (*law)(double, double, double), double step, int steps) {
    RodMobility before = law(0.0, 1.0, 1.0);
    for (int k = 1; k <= steps; ++k) {
        const double length = step * k;
        const RodMobility now = law(length, 1.0, 1.0);
        const bool good = now.parallel > 0.0 && now.perpendicular > 0.0 && now.rotational > 0.0 &&
                          now.parallel < before.parallel && now.perpendicular < before.perpendicular &&
                          now.rotational < before.rotational && now.perpendicular < now.parallel &&
                          now.parallel < 2.0 * now.perpendicular;
        if (!good) FAIL_CHECK("not so at L/D = " << length);
        before = now;
    }
}

}  // namespace

TEST_CASE("capsule: within 0.15, 0.06 and 0.17 % of solutions of the Stokes equations, L/D from 0 to 100") {
    const std::vector<SolvedCapsule> capsules = solved_capsules();
    REQUIRE(capsules.size() == 24);
    for (const auto& [length, solved] : capsules) {
        CAPTURE(length);
        const RodMobility ours = capsule_drag(length, 1.0, 1.0);
        CHECK(std::fabs(ours.parallel / solved.parallel - 1.0) < 0.0015);
        CHECK(std::fabs(ours.perpendicular / solved.perpendicular - 1.0) < 0.0006);
        CHECK(std::fabs(ours.rotational / solved.rotational - 1.0) < 0.0017);
    }
}

TEST_CASE("capsule: rigid multiblobs, another method, agree to the digits that they have") {
    // Over finite_aspect_ratio, from surfaces of up to 20 blobs around, extrapolated in their spacing.
    struct Ratio {
        double length, parallel, perpendicular, rotational;
    };
    for (const auto& [length, parallel, perpendicular, rotational] : {Ratio{0.25, 1.054, 1.058, 1.40},
                                                                      {0.5, 1.073, 1.071, 1.50},
                                                                      {1, 1.072, 1.065, 1.457},
                                                                      {2, 1.052, 1.042, 1.314},
                                                                      {3, 1.036, 1.028, 1.233},
                                                                      {5, 1.018, 1.013, 1.153},
                                                                      {8, 1.008, 1.005, 1.104},
                                                                      {12, 1.003, 1.001, 1.075},
                                                                      {20, 1.000, 0.999, 1.052}}) {
        CAPTURE(length);
        const RodMobility ours = capsule_drag(length, 1.0, 1.0), cylinder = finite_aspect_ratio_drag(length, 1.0, 1.0);
        CHECK(std::fabs(ours.parallel / cylinder.parallel - parallel) < 0.003);
        CHECK(std::fabs(ours.perpendicular / cylinder.perpendicular - perpendicular) < 0.003);
        CHECK(std::fabs(ours.rotational / cylinder.rotational - rotational) < 0.008);
    }
}

TEST_CASE("capsule: length 0 is Stokes' sphere") {
    const double diameter = 1.7, viscosity = 0.3;
    const double stokes = 1.0 / (3.0 * pi * viscosity * diameter);
    const RodMobility sphere = capsule_drag(0.0, diameter, viscosity);
    CHECK(std::fabs(sphere.parallel / stokes - 1.0) < 1e-14);
    CHECK(std::fabs(sphere.perpendicular / stokes - 1.0) < 1e-14);
    CHECK(std::fabs(sphere.rotational * pi * viscosity * std::pow(diameter, 3) - 1.0) < 1e-14);
}

TEST_CASE("capsule: long rods tend to slender-body theory, off by less than 1/ln(p) squared") {
    for (const double p : {1e3, 1e6, 1e12}) {
        const RodMobility ours = capsule_drag(p - 1.0, 1.0, 1.0);
        const double log_2p = std::log(2.0 * p), order = 1.0 / (log_2p * log_2p), ln2 = std::numbers::ln2;
        CHECK(std::fabs(ours.parallel * 2.0 * pi * p / (log_2p - 1.5 + ln2) - 1.0) < order);
        CHECK(std::fabs(ours.perpendicular * 4.0 * pi * p / (log_2p - 0.5 + ln2) - 1.0) < order);
        CHECK(std::fabs(ours.rotational * pi * p * p * p / 3.0 / (log_2p - 11.0 / 6.0 + ln2) - 1.0) < order);
    }
}

TEST_CASE("the paper's cell: L = 2.5 um, D = 1 um in water turns in 1/D_R = 1.887 s, and U_0 = 2 um/s is 1.510 L D_R") {
    const RodMobility mobility = slender_body_drag(2.5, 1.0, 1e-3);
    const double rotational_diffusion = 0.00411 * mobility.rotational;
    CHECK(1.0 / rotational_diffusion == doctest::Approx(1.887).epsilon(0.0005 / 1.887));
    CHECK(2.0 / (2.5 * rotational_diffusion) == doctest::Approx(1.510).epsilon(0.0005 / 1.510));
}

TEST_CASE("slender body by hand at L/D = 5: b = 2 ln 10 - 1 = 3.605170") {
    const double b = 3.605170185988091;
    const RodMobility mobility = slender_body_drag(10.0, 2.0, 0.5);
    CHECK(mobility.parallel == doctest::Approx(2.0 * b / (8.0 * pi * 10.0 * 0.5)).epsilon(1e-14));
    CHECK(mobility.perpendicular == doctest::Approx((b + 2.0) / (8.0 * pi * 10.0 * 0.5)).epsilon(1e-14));
    CHECK(mobility.rotational == doctest::Approx(3.0 * (b + 2.0) / (2.0 * pi * 1000.0 * 0.5)).epsilon(1e-14));
}

TEST_CASE("slender body refuses short rods, with the reason and the way out") {
    CHECK_NOTHROW(slender_body_drag(0.825, 1.0, 1.0));
    for (const double length : {0.0, 0.5, 0.824}) {
        CHECK(refused_key([&] { slender_body_drag(length, 1.0, 1.0); }) == "mobility.model");
    }
    try {
        slender_body_drag(0.5, 1.0, 1.0);
    } catch (const InputError& error) {
        const std::string text = error.what();
        CHECK(text.find("L/D = 0.5") != std::string::npos);
        CHECK(text.find("0.824") != std::string::npos);
        CHECK(text.find("capsule") != std::string::npos);
    }
}

TEST_CASE("values out of range are refused by key in all models") {
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    for (const auto law : {capsule_drag, slender_body_drag, finite_aspect_ratio_drag}) {
        CHECK(refused_key([&] { law(-1.0, 1.0, 1.0); }) == "rods.length");
        CHECK(refused_key([&] { law(nan, 1.0, 1.0); }) == "rods.length");
        CHECK(refused_key([&] { law(5.0, 0.0, 1.0); }) == "rods.diameter");
        CHECK(refused_key([&] { law(5.0, infinity, 1.0); }) == "rods.diameter");
        CHECK(refused_key([&] { law(5.0, 1.0, -2.0); }) == "fluid.viscosity");
        CHECK(refused_key([&] { law(5.0, 1.0, 0.0); }) == "fluid.viscosity");
    }
}

TEST_CASE("finite aspect ratio: length 0 is Stokes' sphere") {
    const double diameter = 1.7, viscosity = 0.3;
    const RodMobility sphere = finite_aspect_ratio_drag(0.0, diameter, viscosity);
    CHECK(sphere.parallel == doctest::Approx(1.0 / (3.0 * pi * viscosity * diameter)).epsilon(1e-14));
    CHECK(sphere.perpendicular == doctest::Approx(sphere.parallel).epsilon(1e-14));
    CHECK(sphere.rotational == doctest::Approx(1.0 / (pi * viscosity * std::pow(diameter, 3))).epsilon(1e-14));
}

TEST_CASE("positive and decreasing with length for L/D in [0, 100], easier along than across") {
    check_order(capsule_drag, 0.005, 20000);
    check_order(finite_aspect_ratio_drag, 0.005, 20000);
    check_order(capsule_drag, 10.0, 100000);
}

TEST_CASE("finite aspect ratio: the joining terms change the published fits by less than 0.3 % for p >= 3") {
    for (double p = 3.0; p < 100.0; p *= 1.1) {
        const RodMobility ours = brackets(p), published = published_brackets(p);
        CHECK(std::fabs(ours.parallel / published.parallel - 1.0) < 0.003);
        CHECK(std::fabs(ours.perpendicular / published.perpendicular - 1.0) < 0.003);
        CHECK(std::fabs(ours.rotational / published.rotational - 1.0) < 0.003);
    }
}

TEST_CASE("long rods: slender body is 6 % off along and across, and turns 27 % too fast") {
    const RodMobility slender = slender_body_drag(1000.0, 1.0, 1.0), capsule = capsule_drag(1000.0, 1.0, 1.0);
    const RodMobility cylinder = finite_aspect_ratio_drag(1000.0, 1.0, 1.0);
    for (const RodMobility& other : {capsule, cylinder}) {
        CHECK(std::fabs(slender.parallel / other.parallel - 1.06) < 0.015);
        CHECK(std::fabs(slender.perpendicular / other.perpendicular - 1.05) < 0.015);
        CHECK(std::fabs(slender.rotational / other.rotational - 1.29) < 0.04);
    }
}
