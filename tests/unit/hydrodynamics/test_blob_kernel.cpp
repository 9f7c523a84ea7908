#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "jostle/hydrodynamics/blob_kernel.hpp"
#include "jostle/hydrodynamics/pair_flow.hpp"

using namespace jostle;
using std::numbers::pi;

namespace {

constexpr double spread = 1.0 / 12.0, viscosity = 0.7;

/// The trapezoidal rule of (1/2 pi^2) k^2 spectrum(k) over directions: isotropic and radial part of the flow of
/// (I - kk/k^2) spectrum(k).
template <class Spectrum>
BlobFlow from_spectrum(double r, Spectrum&& spectrum) {
    const double step = 1e-3;
    BlobFlow sum;
    for (int n = 1; n < 60000; ++n) {
        const double k = step * n, x = k * r;
        // Means over directions of cos(k.r) times 1 and times the square of the cosine of the angle to r.
        const double all = std::sin(x) / x,
                     along = (x * x - 2.0) * std::sin(x) / (x * x * x) + 2.0 * std::cos(x) / (x * x);
        const double weight = step * k * k * spectrum(k) / (2.0 * pi * pi);
        const double rr = all - along, perpendicular = all - 0.5 * (all - along);
        sum.isotropic += weight * perpendicular;
        sum.radial += weight * (rr - perpendicular) / (r * r);
    }
    return sum;
}

/// The same of the rotlet, -(1/r) d/dr of the scalar whose spectrum this is.
template <class Spectrum>
double rotlet_from_spectrum(double r, Spectrum&& spectrum) {
    const double step = 1e-3;
    double sum = 0.0;
    for (int n = 1; n < 60000; ++n) {
        const double k = step * n, x = k * r;
        sum += step * std::pow(k, 4) * spectrum(k) * (std::sin(x) - x * std::cos(x)) / (x * x * x) / (2.0 * pi * pi);
    }
    return sum;
}

void check_equal(const BlobFlow& a, const BlobFlow& b, double relative) {
    CHECK(a.isotropic == doctest::Approx(b.isotropic).epsilon(relative));
    CHECK(a.radial == doctest::Approx(b.radial).epsilon(relative));
}

}  // namespace

TEST_CASE("flows of blobs are the Fourier integrals of their spectra") {
    constexpr double splitting = 1.3;
    for (const double r : {0.3, 0.9, 2.5}) {
        CAPTURE(r);
        check_equal(stokes_flow(spread, viscosity, r * r),
                    from_spectrum(r, [](double k) { return std::exp(-k * k * spread) / (viscosity * k * k); }), 2e-4);
        check_equal(solenoidal_gaussian(spread, viscosity, r * r),
                    from_spectrum(r, [](double k) { return std::exp(-k * k * spread) / viscosity; }), 1e-7);
        check_equal(near_flow(spread, splitting, viscosity, r * r),
                    from_spectrum(r,
                                  [](double k) {
                                      const double q = 0.25 * k * k / (splitting * splitting);
                                      return std::exp(-k * k * spread) * (1.0 - (1.0 + q) * std::exp(-q)) /
                                             (viscosity * k * k);
                                  }),
                    1e-6);
    }
}

TEST_CASE("flows of couples are the Fourier integrals of their spectra") {
    constexpr double splitting = 1.3;
    const auto near = [](double k) {
        const double q = 0.25 * k * k / (splitting * splitting);
        return std::exp(-k * k * spread) * (1.0 - (1.0 + q) * std::exp(-q)) / viscosity;
    };
    for (const double r : {0.3, 0.9, 2.5}) {
        CAPTURE(r);
        const double squared = r * r;
        CHECK(rotlet(spread, viscosity, squared) == doctest::Approx(rotlet_from_spectrum(r, [](double k) {
                                                        return 0.5 * std::exp(-k * k * spread) / (viscosity * k * k);
                                                    })).epsilon(1e-6));
        CHECK(
            near_rotlet(spread, splitting, viscosity, squared) ==
            doctest::Approx(rotlet_from_spectrum(r, [&](double k) { return 0.5 * near(k) / (k * k); })).epsilon(1e-6));
        check_equal(turning(spread, viscosity, squared),
                    from_spectrum(r, [](double k) { return 0.25 * std::exp(-k * k * spread) / viscosity; }), 1e-6);
        check_equal(near_turning(spread, splitting, viscosity, squared),
                    from_spectrum(r, [&](double k) { return 0.25 * near(k); }), 1e-6);
    }
    const double joint = 4.0 * spread;  // of series and closed form
    CHECK(rotlet(spread, viscosity, joint * (1 - 1e-13)) ==
          doctest::Approx(rotlet(spread, viscosity, joint)).epsilon(1e-11));
}

TEST_CASE("flows do not jump where series give way to closed forms") {
    const double at = 4.0 * spread;
    check_equal(stokes_flow(spread, viscosity, at * (1 - 1e-13)), stokes_flow(spread, viscosity, at), 1e-11);
    check_equal(solenoidal_gaussian(spread, viscosity, at * (1 - 1e-13)), solenoidal_gaussian(spread, viscosity, at),
                1e-11);
}

TEST_CASE("a blob alone has the mobility of its Gaussian; far away its flow is that of a sphere with its Faxen terms") {
    const double sigma = std::sqrt(spread);
    CHECK(stokes_flow(spread, viscosity, 0.0).isotropic ==
          doctest::Approx(1.0 / (6.0 * std::pow(pi, 1.5) * viscosity * sigma)).epsilon(1e-14));
    const double radius = 0.5, r = 6.0;  // of the sphere of diameter 1
    const double oseen = 1.0 / (8.0 * pi * viscosity * r), faxen = 2.0 * radius * radius / (3.0 * r * r);
    const BlobFlow flow = stokes_flow(spread, viscosity, r * r);  // Rotne and Prager 1969
    CHECK(flow.isotropic == doctest::Approx(oseen * (1.0 + faxen)).epsilon(1e-12));
    CHECK(flow.radial * r * r == doctest::Approx(oseen * (1.0 - 3.0 * faxen)).epsilon(1e-12));
}

TEST_CASE("tables of flows: values, and what they change by along a direction") {
    const PairFlow open = PairFlow::unbounded(spread, viscosity), near = PairFlow::near(spread, 0.8, viscosity, 4.0);
    const Vec3 direction = normalised({1, -2, 0.5});
    for (const double r : {0.0, 0.2, 0.7, 1.9, 3.3, 3.47, 9.0}) {
        CAPTURE(r);
        check_equal(open.at(r * r), stokes_flow(spread, viscosity, r * r), 1e-8);
        const Vec3 place = r * normalised({1, 1, 0.3});
        for (const PairFlow* flow : {&open, &near}) {
            const double step = 1e-5;
            const auto at = [&](double s) {
                const Vec3 shifted = place + s * direction;
                const double squared = squared_norm(shifted);
                return flow == &open ? stokes_flow(spread, viscosity, squared).of(shifted, direction)
                       : r < 4.0     ? near_flow(spread, 0.8, viscosity, squared).of(shifted, direction)
                                     : Vec3{};
            };
            const Vec3 change = (0.5 / step) * (at(step) - at(-step));
            CHECK(norm(flow->with_slope(r * r).along(place, direction) - change) < 1e-6);
        }
    }
    CHECK(near.at(16.01).isotropic == 0.0);
}

// Floats: of functions that are tabulated to less than their rounding, at distances that round by as much.
TEST_CASE("flows of four pairs at once are those of each, in floats") {
    constexpr double rounding = 8.0 * std::numeric_limits<float>::epsilon();
    const PairFlow open = PairFlow::unbounded(spread, viscosity), near = PairFlow::near(spread, 0.8, viscosity, 4.0);
    for (const PairFlow* flow : {&open, &near})
        for (const std::array<double, 4>& distances :
             {std::array{0.0, 0.3, 0.9, 1.0}, std::array{1.7, 2.9, 3.3, 3.99}, std::array{3.46, 3.47, 4.01, 9.0}}) {
            Four squared{};
            for (std::size_t k = 0; k < 4; ++k) squared[k] = static_cast<float>(distances[k] * distances[k]);
            const FourFlows values = flow->at(squared);
            const FourFlowSlopes with_slope = flow->with_slope(squared);
            for (std::size_t k = 0; k < 4; ++k) {
                CAPTURE(distances[k]);
                const BlobFlowSlope exact = flow->with_slope(static_cast<double>(squared[k]));
                const BlobFlow largest = flow->at(0.0);
                CHECK(std::fabs(values.isotropic[k] - exact.flow.isotropic) < rounding * largest.isotropic);
                CHECK(std::fabs(values.radial[k] - exact.flow.radial) < rounding * largest.radial);
                CHECK(with_slope.flow.isotropic[k] == values.isotropic[k]);
                CHECK(with_slope.flow.radial[k] == values.radial[k]);
                CHECK(std::fabs(with_slope.slope.isotropic[k] - exact.slope.isotropic) < 1e-5 * largest.radial);
                CHECK(std::fabs(with_slope.slope.radial[k] - exact.slope.radial) < 1e-5 * largest.radial / spread);
            }
        }
    CHECK(near.any_flow(Four{20.0F, 15.9F, 20.0F, 20.0F}));
    CHECK(!near.any_flow(Four{20.0F, 16.1F, 20.0F, 20.0F}));
    CHECK(open.any_flow(Four{1e6F, 1e6F, 1e6F, 1e6F}));
}
