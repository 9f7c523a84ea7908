#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

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

}  // namespace

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
        CHECK(text.find("finite_aspect_ratio") != std::string::npos);
    }
}

TEST_CASE("values out of range are refused by key in both models") {
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    for (const auto law : {slender_body_drag, finite_aspect_ratio_drag}) {
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

TEST_CASE("finite aspect ratio: positive and decreasing with length for L/D in [0, 100], easier along than across") {
    RodMobility before = finite_aspect_ratio_drag(0.0, 1.0, 1.0);
    for (int k = 1; k <= 20000; ++k) {
        const double length = 0.005 * k;
        const RodMobility now = finite_aspect_ratio_drag(length, 1.0, 1.0);
        CAPTURE(length);
        const bool good = now.parallel > 0.0 && now.perpendicular > 0.0 && now.rotational > 0.0 &&
                          now.parallel < before.parallel && now.perpendicular < before.perpendicular &&
                          now.rotational < before.rotational && now.perpendicular < now.parallel &&
                          now.parallel < 2.0 * now.perpendicular;
        if (!good) FAIL_CHECK("not so at L/D = " << length);
        before = now;
    }
}

TEST_CASE("finite aspect ratio: the joining terms change the published fits by less than 0.3 % for p >= 3") {
    for (double p = 3.0; p < 100.0; p *= 1.1) {
        const RodMobility ours = brackets(p), published = published_brackets(p);
        CHECK(std::fabs(ours.parallel / published.parallel - 1.0) < 0.003);
        CHECK(std::fabs(ours.perpendicular / published.perpendicular - 1.0) < 0.003);
        CHECK(std::fabs(ours.rotational / published.rotational - 1.0) < 0.003);
    }
}

TEST_CASE("both models agree within 10 % in the limit of long rods") {
    const RodMobility slender = slender_body_drag(1000.0, 1.0, 1.0),
                      finite = finite_aspect_ratio_drag(1000.0, 1.0, 1.0);
    CHECK(slender.parallel == doctest::Approx(finite.parallel).epsilon(0.1));
    CHECK(slender.perpendicular == doctest::Approx(finite.perpendicular).epsilon(0.1));
    CHECK(slender.rotational == doctest::Approx(finite.rotational).epsilon(0.1));
}
