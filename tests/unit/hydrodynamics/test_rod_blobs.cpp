#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "jostle/error/input_error.hpp"
#include "jostle/hydrodynamics/blob_kernel.hpp"
#include "jostle/hydrodynamics/rod_blobs.hpp"

using namespace jostle;

namespace {

Rods rods_of(const std::vector<double>& lengths, double diameter = 1.0) {
    Rods rods;
    for (const double length : lengths) rods.push_back(rods.size(), {}, {1, 0, 0}, length, diameter);
    return rods;
}

bool is_refused(const Rods& rods) {
    try {
        blobs_of(rods, 1.0);
    } catch (const InputError& error) {
        return error.parts().key == "mobility.model";
    }
    return false;
}

}  // namespace

TEST_CASE("a line of blobs is as mobile as its rod, but for a few per cent that are added: for every L/D up to 20") {
    for (int n = 0; n <= 400; ++n) {
        const double length = 0.05 * n;
        CAPTURE(length);
        const RodBlobs blobs = blobs_of(rods_of({length}), 0.7);
        const BlobLine& line = blobs.of(0);
        for (const auto share : {&RodMobility::parallel, &RodMobility::perpendicular}) {
            CHECK(line.remainder.*share >= 0.0);
            CHECK(line.remainder.*share < 0.075 * line.own.*share);
        }
        CHECK(line.remainder.rotational >= 0.0);
        if (length > 0.0) CHECK(line.remainder.rotational < 0.19 * line.own.rotational);
        double forces = 0.0, moments = 0.0, torque = 0.0;
        for (std::size_t b = 0; b < line.place.size(); ++b) {
            forces += line.force_weight[b];
            moments += line.moment_weight[b];
            torque += line.moment_weight[b] * line.place[b];
        }
        CHECK(forces == doctest::Approx(1.0).epsilon(1e-14));
        CHECK(moments == doctest::Approx(0.0));
        if (length > 0.0) CHECK(torque == doctest::Approx(1.0).epsilon(1e-12));
    }
}

TEST_CASE("a sphere is one blob of 97.7 % of its mobility") {
    const RodBlobs blobs = blobs_of(rods_of({0.0}, 2.0), 0.7);
    const BlobLine& line = blobs.of(0);
    CHECK(line.place.size() == 1);
    CHECK(blobs.spread() == doctest::Approx(4.0 / 12.0).epsilon(1e-14));
    CHECK(line.own.parallel == doctest::Approx(1.0 / (3.0 * std::numbers::pi * 0.7 * 2.0)));
    CHECK(line.remainder.parallel / line.own.parallel == doctest::Approx(0.02276).epsilon(1e-3));
}

// Velocity of each of two rods L/D = 5 side by side under equal forces, over that of one: along the axes, across them
// normal to the plane, and along the line of centres. Far away it is that of point forces, 1 + (1, 1, 2)/(8 pi mu h
// own): the next order falls as h^-3.
TEST_CASE("two parallel rods, far apart, drag each other along as point forces do") {
    const RodBlobs blobs = blobs_of(rods_of({5.0}), 1.0);
    const BlobLine& line = blobs.of(0);
    for (const double h : {50.0, 100.0}) {
        double along = 0.0, across = 0.0;
        for (std::size_t b = 0; b < line.place.size(); ++b)
            for (std::size_t c = 0; c < line.place.size(); ++c) {
                const double apart = line.place[b] - line.place[c];
                const BlobFlow flow = stokes_flow(blobs.spread(), 1.0, apart * apart + h * h);
                const double weight = line.force_weight[b] * line.force_weight[c];
                along += weight * (flow.isotropic + flow.radial * apart * apart);
                across += weight * (flow.isotropic + flow.radial * h * h);
            }
        const double oseen = 1.0 / (8.0 * std::numbers::pi * h);
        CHECK(std::fabs(along / oseen - 1.0) < 10.0 / (h * h));
        CHECK(std::fabs(across / oseen - 2.0) < 20.0 / (h * h));
    }
}

TEST_CASE("rods of several lengths have blobs of one width; several diameters and longer rods are refused") {
    const RodBlobs blobs = blobs_of(rods_of({5.0, 0.0, 2.5, 5.0}), 1.0);
    CHECK(blobs.lines().size() == 3);
    CHECK(blobs.of(0).length == 5.0);
    CHECK(blobs.of(1).length == 0.0);
    CHECK(blobs.of(2).length == 2.5);
    CHECK(blobs.line_of[3] == blobs.line_of[0]);
    for (const BlobLine& line : blobs.lines())
        CHECK(std::min({line.remainder.parallel, line.remainder.perpendicular, line.remainder.rotational}) >= 0.0);
    CHECK(is_refused(rods_of({20.1})));
    CHECK_FALSE(is_refused(rods_of({20.0})));
    Rods two = rods_of({1.0, 1.0});
    two.diameter[1] = 1.001;
    CHECK(is_refused(two));
}
