// Facts about the pair stress of rigid bodies of any shape (theory, section 1). Each holds exactly, so tolerances are
// rounding.

#include <doctest/doctest.h>

#include <limits>

#include "jostle/error/input_error.hpp"
#include "jostle/stress/stress.hpp"
#include "random_bodies.hpp"

using namespace jostle;
using namespace jostle::test;

namespace {

constexpr std::uint64_t seed = 2019;
constexpr int pairs = 2000;

struct RandomPair {
    RigidBody body_1, body_2;
    Vec3 point_1, point_2;

    explicit RandomPair(std::mt19937_64& generator)
        : body_1(random_body(generator)),
          body_2(random_body(generator)),
          point_1(random_vector(generator)),
          point_2(random_vector(generator)) {}

    /// From the application point on body 1 to the one on body 2.
    Vec3 separation() const { return body_2.centre + point_2 - body_1.centre - point_1; }
    PairStress stress(const Vec3& force) const { return pair_stress(body_1, body_2, point_1, point_2, force); }
};

double distance(const Mat3& a, const Mat3& b) {
    return norm(a - b);
}

RigidBody sphere(const Vec3& centre, double radius) {
    return {centre, radius * radius * identity()};
}

}  // namespace

TEST_CASE("a frictionless contact has a symmetric stress; the paper's sign on body 1 does not") {
    std::mt19937_64 generator(seed);
    MESSAGE("seed ", seed);
    double largest = 0.0, as_printed = 0.0;
    for (int k = 0; k < pairs; ++k) {
        const RandomPair pair(generator);
        const Vec3 force = 1.7 * normalised(pair.separation());
        const PairStress parts = pair.stress(force);
        largest = std::max(largest, relative_asymmetry(parts.total()));
        as_printed += relative_asymmetry(parts.total() - 2.0 * parts.geometric_1) / pairs;
    }
    MESSAGE("largest relative asymmetry ", largest, ", mean with the paper's sign ", as_printed);
    CHECK(largest < 1e-12);
    CHECK(as_printed > 0.1);
}

TEST_CASE("a force off the line between its two points gives eps:sigma = d x F") {
    std::mt19937_64 generator(seed + 1);
    MESSAGE("seed ", seed + 1);
    for (int k = 0; k < pairs; ++k) {
        const RandomPair pair(generator);
        const Vec3 force = random_vector(generator);
        const PairStress parts = pair.stress(force);
        const Mat3 stress = parts.total();
        CHECK(norm(axial(stress) - cross(pair.separation(), force)) < 1e-13 * (norm(stress) + norm(force)) * 10.0);
        CHECK(norm(parts.axial() - axial(stress)) == 0.0);
        CHECK(parts.asymmetry() == doctest::Approx(std::sqrt(2.0) * norm(parts.axial()) / norm(stress)));
    }
}

TEST_CASE("the geometric part is traceless: Tr sigma = (r_2 - r_1).F") {
    std::mt19937_64 generator(seed + 2);
    MESSAGE("seed ", seed + 2);
    for (int k = 0; k < pairs; ++k) {
        const RandomPair pair(generator);
        const Vec3 force = random_vector(generator);
        const PairStress parts = pair.stress(force);
        CHECK(std::fabs(trace(parts.geometric_1)) < 1e-14 * (1.0 + norm(parts.geometric_1)));
        CHECK(std::fabs(trace(parts.geometric_2)) < 1e-14 * (1.0 + norm(parts.geometric_2)));
        const double virial = dot(pair.body_2.centre - pair.body_1.centre, force);
        CHECK(trace(parts.total()) == doctest::Approx(virial).epsilon(1e-12).scale(norm(force)));
    }
}

TEST_CASE("the scale of the density drops out; exchanging the bodies changes nothing") {
    std::mt19937_64 generator(seed + 3);
    MESSAGE("seed ", seed + 3);
    for (int k = 0; k < 100; ++k) {
        const RandomPair pair(generator);
        const Vec3 force = random_vector(generator);
        const Mat3 stress = pair.stress(force).total();
        RandomPair denser = pair;
        denser.body_1.second_moment *= 1e6;
        denser.body_2.second_moment *= 1e-3;
        CHECK(distance(denser.stress(force).total(), stress) < 1e-13 * norm(stress));
        const Mat3 exchanged = pair_stress(pair.body_2, pair.body_1, pair.point_2, pair.point_1, -force).total();
        CHECK(distance(exchanged, stress) < 1e-13 * norm(stress));
    }
}

TEST_CASE("several contacts on one body superpose, through the torque alone") {
    std::mt19937_64 generator(seed + 4);
    MESSAGE("seed ", seed + 4);
    const Mat3 moment = random_second_moment(generator);
    Mat3 sum;
    Vec3 torque;
    for (int k = 0; k < 20; ++k) {
        const Vec3 point = random_vector(generator), force = random_vector(generator);
        sum += geometric_stress(moment, point, force);
        torque += cross(point, force);
        // A force may slide along its own line: contact points on the surface and on the centre line are as good.
        CHECK(distance(geometric_stress(moment, point + 0.7 * force, force), geometric_stress(moment, point, force)) <
              1e-13 * (1.0 + norm(force) * norm(force)));
    }
    CHECK(distance(sum, geometric_stress(moment, torque)) < 1e-12 * norm(torque));
}

TEST_CASE("inertia: G = tr(N) I - N, and the angular momentum of s^G is the torque") {
    std::mt19937_64 generator(seed + 5);
    MESSAGE("seed ", seed + 5);
    for (int k = 0; k < 100; ++k) {
        const Mat3 moment = random_second_moment(generator);
        const Vec3 omega = random_vector(generator);
        const Vec3 torque = inertia(moment) * omega;  // then DOmega = omega, and s^G_ij = eps_jkl N_il omega_k
        Mat3 expected;
        for (int i = 0; i < 3; ++i) {
            expected(i, 0) = moment(i, 2) * omega.y - moment(i, 1) * omega.z;
            expected(i, 1) = moment(i, 0) * omega.z - moment(i, 2) * omega.x;
            expected(i, 2) = moment(i, 1) * omega.x - moment(i, 0) * omega.y;
        }
        CHECK(distance(geometric_stress(moment, torque), expected) < 1e-12 * norm(expected));
        CHECK(norm(axial(geometric_stress(moment, torque)) - torque) < 1e-12 * norm(torque));
    }
    CHECK(inertia(Mat3{{1, 0, 0, 0, 2, 0, 0, 0, 3}}).m == Mat3{{5, 0, 0, 0, 4, 0, 0, 0, 3}}.m);
}

//      (1) e-> (2)     spheres touching at one point, radii R_1 and R_2, F on (2) with friction
TEST_CASE("spheres: (r_2 - r_1) F without friction; (R_1 + R_2)/2 (e F + F e) with friction") {
    const Vec3 e = normalised({1, 2, -2});
    const Vec3 force = {0.3, -1.1, 0.8};
    for (const double radius_2 : {1.0, 2.5}) {
        const RigidBody body_1 = sphere({0, 0, 0}, 1.0), body_2 = sphere((1.0 + radius_2) * e, radius_2);
        const Mat3 frictionless = pair_stress(body_1, body_2, e, -radius_2 * e, e).total();
        CHECK(distance(frictionless, (1.0 + radius_2) * outer(e, e)) < 1e-14);

        const PairStress parts = pair_stress(body_1, body_2, e, -radius_2 * e, force);
        const Mat3 difference = outer(e, force) - outer(force, e);
        CHECK(distance(parts.geometric_1, -0.5 * difference) < 1e-14);
        CHECK(distance(parts.geometric_2, (-0.5 * radius_2) * difference) < 1e-14);
        const Mat3 expected = (0.5 * (1.0 + radius_2)) * (outer(e, force) + outer(force, e));
        CHECK(distance(parts.total(), expected) < 1e-14);
    }
}

TEST_CASE("conventions: same forces, three tensors") {
    std::mt19937_64 generator(seed + 6);
    MESSAGE("seed ", seed + 6);
    const RandomPair pair(generator);
    const Vec3 force = pair.separation();
    const auto in = [&](StressConvention convention) {
        return pair_stress(convention, pair.body_1, pair.body_2, pair.point_1, pair.point_2, force);
    };
    CHECK(in(StressConvention::rigid_body).m == pair.stress(force).total().m);
    CHECK(in(StressConvention::centre_of_mass_virial).m == pair.stress(force).centre_of_mass_virial.m);
    CHECK(distance(in(StressConvention::centre_line), outer(pair.separation(), force)) < 1e-14 * squared_norm(force));
    CHECK(relative_asymmetry(in(StressConvention::centre_line)) < 1e-14);
    CHECK(relative_asymmetry(in(StressConvention::centre_of_mass_virial)) > 1e-2);
}

TEST_CASE("second moments that no body has are refused") {
    const Vec3 torque = {1, 0, 0};
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    CHECK_THROWS_AS(geometric_stress(Mat3{{1, 0, 0, 0, nan, 0, 0, 0, 1}}, torque), InputError);
    CHECK_THROWS_AS(geometric_stress(Mat3{{infinity, 0, 0, 0, 1, 0, 0, 0, 1}}, torque), InputError);
    CHECK_THROWS_AS(geometric_stress(Mat3{{1, 0.1, 0, 0, 1, 0, 0, 0, 1}}, torque), InputError);
    CHECK_THROWS_AS(geometric_stress(Mat3{{-1, 0, 0, 0, 2, 0, 0, 0, 3}}, torque), InputError);
    CHECK_THROWS_AS(geometric_stress(Mat3{{0, 0, 0, 0, 0, 0, 0, 0, 1}}, torque), InputError);  // a line
    CHECK_THROWS_AS(geometric_stress(Mat3{}, torque), InputError);
    CHECK_NOTHROW(geometric_stress(Mat3{{0, 0, 0, 0, 1, 0, 0, 0, 1}}, torque));  // a plate
}
