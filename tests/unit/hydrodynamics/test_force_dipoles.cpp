#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <random>

#include "jostle/hydrodynamics/blob_kernel.hpp"
#include "jostle/hydrodynamics/hydrodynamic_mobility.hpp"
#include "jostle/hydrodynamics/line_vector.hpp"
#include "jostle/hydrodynamics/rod_blobs.hpp"

using namespace jostle;

namespace {

constexpr double pi = std::numbers::pi, viscosity = 0.7;
const Box open{{20, 20, 20}, {false, false, false}};

Velocities stirred(const Rods& rods, const Box& box, std::vector<double> dipole, double kT = 0.0,
                   double tolerance = 1e-6) {
    Velocities velocities(rods.size());
    HydrodynamicMobility(viscosity, tolerance)
        .at(rods, box)
        ->add_axial_flow({.kT = kT, .dipole = std::move(dipole)}, velocities);
    return velocities;
}

/// A swimmer of this length, and one in its neighbourhood that does not stir.
Rods two_rods(double length, double other_length, const Vec3& apart) {
    Rods rods;
    rods.push_back(0, {1, 2, 3}, normalised(Vec3{1, 2, -0.5}), length, 1.0);
    rods.push_back(1, Vec3{1, 2, 3} + apart, normalised(Vec3{-0.3, 1, 1}), other_length, 1.0);
    return rods;
}

/// Velocity and rate of turning of rod 1, from the velocity at each of its blobs.
template <class FlowAtBlob>
LineVector of_blobs(const Rods& rods, const RodBlobs& blobs, FlowAtBlob&& flow) {
    LineVector sum;
    const BlobLine& line = blobs.of(1);
    for (std::size_t b = 0; b < line.place.size(); ++b) {
        const Vec3 u = flow(rods.centre[1] + line.place[b] * rods.axis[1]);
        sum.centre += line.force_weight[b] * u;
        sum.moment += line.moment_weight[b] * u;
    }
    return {sum.centre, across(rods.axis[1], sum.moment)};
}

/// Flows are floats: how fast the rod turns, which is the small difference of these along it, is rounded as they are.
void check_close(const Velocities& found, const Rods& rods, const LineVector& expected, double relative) {
    const double rounding = std::numeric_limits<float>::epsilon() * norm(expected.centre);
    CHECK(norm(found.linear[1] - expected.centre) < relative * norm(expected.centre));
    CHECK(norm(found.angular[1] - cross(rods.axis[1], expected.moment)) < relative * norm(expected.moment) + rounding);
}

}  // namespace

// Batchelor, J. Fluid Mech. 41, 545 (1970): u = p (3 cos^2 theta - 1)/(8 pi mu r^2) along r. No net force acts, so that
// it falls as 1/r^2, and not as 1/r.
TEST_CASE("far from a swimmer the fluid flows as from a force dipole, of rods and of spheres") {
    for (const double length : {0.0, 1.0, 5.0})
        for (const double dipole : {2.0, -3.0})
            for (const Vec3& direction : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{1, 2, -0.5}, Vec3{0.3, -0.2, 1}})
                for (const double distance : {200.0, 400.0}) {
                    const Vec3 along = normalised(direction);
                    const Rods rods = two_rods(length, 0.0, distance * along);
                    const double cosine = dot(rods.axis[0], along);
                    const double size = dipole / (8.0 * pi * viscosity * distance * distance);
                    const Velocities u = stirred(rods, open, {dipole, 0.0});
                    const double allowed = 10.0 * (length + 1.0) * (length + 1.0) / (distance * distance);
                    CHECK(norm(u.linear[1] - (size * (3.0 * cosine * cosine - 1.0)) * along) <
                          allowed * std::fabs(size));
                    CHECK(u.linear[0] == Vec3{});  // its own dipole moves it nowhere
                    CHECK(u.angular[0] == Vec3{});
                }
}

TEST_CASE("two swimmers: the flow of blob forces p rho n of one, as the blobs of the other feel it") {
    for (const double distance : {1.5, 3.0, 9.0}) {
        const Rods rods = two_rods(5.0, 3.0, distance * normalised(Vec3{0.2, -1, 0.4}));
        const RodBlobs blobs = blobs_of(rods, viscosity);
        const double dipole = -1.7;
        const LineVector expected = of_blobs(rods, blobs, [&](const Vec3& at) {
            Vec3 u;
            const BlobLine& line = blobs.of(0);
            for (std::size_t c = 0; c < line.place.size(); ++c) {
                const Vec3 r = rods.centre[0] + line.place[c] * rods.axis[0] - at;
                u += stokes_flow(blobs.spread(), viscosity, squared_norm(r))
                         .of(r, (dipole * line.moment_weight[c]) * rods.axis[0]);
            }
            return u;
        });
        check_close(stirred(rods, open, {dipole, 0.0}), rods, expected, 1e-6);
    }
}

// The same with the flow of all images: a sum over waves, which the width of the blobs ends.
TEST_CASE("two swimmers in a periodic box: against the sum over waves, rods and a sphere that stirs") {
    const Vec3 edges{12, 13, 14};
    for (const double length : {5.0, 0.0}) {
        const Rods rods = two_rods(length, 3.0, {2.0, -1.5, 1.0});
        const RodBlobs blobs = blobs_of(rods, viscosity);
        const double dipole = 2.3;
        const BlobLine& source = blobs.of(0);
        const auto spectrum_of_source = [&](const Vec3& k) -> std::complex<double> {
            const std::complex<double> i(0, 1);
            if (length == 0.0) return -i * dipole * dot(k, rods.axis[0]) * std::exp(-i * dot(k, rods.centre[0]));
            std::complex<double> sum = 0.0;
            for (std::size_t c = 0; c < source.place.size(); ++c)
                sum += dipole * source.moment_weight[c] *
                       std::exp(-i * dot(k, rods.centre[0] + source.place[c] * rods.axis[0]));
            return sum;
        };
        const BlobLine& line = blobs.of(1);
        LineVector expected;
        constexpr int waves = 32;
        for (int x = -waves; x <= waves; ++x)
            for (int y = -waves; y <= waves; ++y)
                for (int z = -waves; z <= waves; ++z) {
                    if (x == 0 && y == 0 && z == 0) continue;
                    const Vec3 k{2 * pi * x / edges.x, 2 * pi * y / edges.y, 2 * pi * z / edges.z};
                    const double squared = squared_norm(k), decay = squared * blobs.spread();
                    if (decay > 25.0) continue;
                    const Vec3 along = rods.axis[0] - (dot(k, rods.axis[0]) / squared) * k;
                    const std::complex<double> from =
                        spectrum_of_source(k) * std::exp(-decay) / (viscosity * edges.x * edges.y * edges.z * squared);
                    for (std::size_t b = 0; b < line.place.size(); ++b) {
                        const double phase = dot(k, rods.centre[1] + line.place[b] * rods.axis[1]);
                        const double wave = (from * std::polar(1.0, phase)).real();
                        expected.centre += (line.force_weight[b] * wave) * along;
                        expected.moment += (line.moment_weight[b] * wave) * along;
                    }
                }
        expected.moment = across(rods.axis[1], expected.moment);
        const Velocities found = stirred(rods, Box{edges}, {dipole, 0.0});
        check_close(found, rods, expected, 1e-5);
    }
}

TEST_CASE("swimmers and thermal turning share one flow: it is the sum of the two") {
    for (const bool periodic : {false, true}) {
        const Box box{{12, 13, 14}, {periodic, periodic, periodic}};
        // Flows are floats. Near a blob the flow is that of forces up to 3.6/D rho_c = 0.6, through a mobility of 0.1;
        // along the rod it cancels.
        const double rounding = 0.06 * std::numeric_limits<float>::epsilon();
        const Rods rods = two_rods(5.0, 2.0, {2.0, -1.5, 1.0});
        const Velocities both = stirred(rods, box, {2.0, -1.0}, 0.8);
        const Velocities swimmers = stirred(rods, box, {2.0, -1.0}), drift = stirred(rods, box, {}, 0.8);
        for (std::size_t i = 0; i < 2; ++i) {
            CHECK(norm(both.linear[i] - swimmers.linear[i] - drift.linear[i]) < rounding);
            CHECK(norm(both.angular[i] - swimmers.angular[i] - drift.angular[i]) < rounding);
        }
    }
}
