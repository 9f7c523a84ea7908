// The stress of a list of contacts between bodies of any shape.

#include <doctest/doctest.h>

#include <limits>

#include "jostle/error/input_error.hpp"
#include "jostle/stress/contact_stress.hpp"
#include "jostle/stress/stress.hpp"
#include "random_bodies.hpp"

using namespace jostle;
using namespace jostle::test;

namespace {

/// Bodies of all kinds with many contacts each; every second force has friction.
struct Packing {
    std::vector<RigidBody> bodies;
    std::vector<Mat3> second_moments;
    std::vector<BodyContact> contacts;

    Packing(std::mt19937_64& generator, std::uint32_t count, bool friction) {
        for (std::uint32_t k = 0; k < count; ++k) {
            bodies.push_back(random_body(generator));
            second_moments.push_back(bodies.back().second_moment);
        }
        std::uniform_int_distribution<std::uint32_t> pick(0, count - 1);
        for (std::uint32_t l = 0; l < 8 * count; ++l) {
            const std::uint32_t i = pick(generator), j = (i + 1 + pick(generator) % (count - 1)) % count;
            const Vec3 separation = bodies[j].centre - bodies[i].centre;
            const Vec3 point_1 = random_vector(generator), point_2 = random_vector(generator);
            const Vec3 normal = normalised(separation + point_2 - point_1);
            const Vec3 force = friction ? random_vector(generator) : 0.3 * normal;
            contacts.push_back({i, j, separation, point_1, point_2, force});
        }
    }
};

constexpr std::array conventions = {StressConvention::rigid_body, StressConvention::centre_of_mass_virial,
                                    StressConvention::centre_line};

}  // namespace

TEST_CASE("the list is the sum of the pairs, and the bodies' stresses add up to it, in every convention") {
    std::mt19937_64 generator(41);
    MESSAGE("seed 41");
    const Packing packing(generator, 30, true);
    for (const StressConvention convention : conventions) {
        const ContactStress stress = contact_stress(packing.second_moments, packing.contacts, convention);
        Mat3 pairs, bodies;
        for (const BodyContact& contact : packing.contacts)
            pairs += pair_stress(convention, packing.bodies[contact.body_1], packing.bodies[contact.body_2],
                                 contact.point_1, contact.point_2, contact.force);
        for (const Mat3& body : stress.per_body) bodies += body;
        CHECK(norm(stress.total() - pairs) < 1e-12 * norm(pairs));
        CHECK(norm(bodies - pairs) < 1e-12 * norm(pairs));
        CHECK(std::fabs(trace(stress.geometric)) < 1e-12 * (1.0 + norm(stress.geometric)));
        CHECK((norm(stress.geometric) > 0.0) == (convention == StressConvention::rigid_body));
    }
}

TEST_CASE("without friction the sum is symmetric; with it eps:sigma = sum of d x F") {
    std::mt19937_64 generator(42);
    MESSAGE("seed 42");
    const Packing smooth(generator, 30, false), rough(generator, 30, true);
    CHECK(relative_asymmetry(contact_stress(smooth.second_moments, smooth.contacts).total()) < 1e-12);
    const Mat3 stress = contact_stress(rough.second_moments, rough.contacts).total();
    Vec3 expected;
    for (const BodyContact& contact : rough.contacts)
        expected += cross(contact.separation + contact.point_2 - contact.point_1, contact.force);
    CHECK(norm(axial_vector(stress) - expected) < 1e-12 * norm(stress));
    CHECK(relative_asymmetry(stress) > 1e-3);
}

//    (0)|(1)|(2)   three touching spheres of diameter 1 in a row, pushed together with force 2
TEST_CASE("three spheres in a row, by hand") {
    const std::vector<Mat3> spheres(3, sphere_moments(1.0).second_moment);
    const Vec3 x = {1, 0, 0};
    const std::vector<BodyContact> contacts = {{0, 1, x, 0.5 * x, -0.5 * x, 2.0 * x},
                                               {1, 2, x, 0.5 * x, -0.5 * x, 2.0 * x}};
    const ContactStress stress = contact_stress(spheres, contacts);
    CHECK(norm(stress.total() - 4.0 * outer(x, x)) == 0.0);
    CHECK(norm(stress.per_body[0] - outer(x, x)) == 0.0);
    CHECK(norm(stress.per_body[1] - 2.0 * outer(x, x)) == 0.0);
    CHECK(norm(stress.per_body[2] - outer(x, x)) == 0.0);
}

TEST_CASE("a body that meets its own periodic image counts in full") {
    const std::vector<Mat3> sphere = {sphere_moments(1.0).second_moment};
    const Vec3 x = {1, 0, 0};
    const ContactStress stress = contact_stress(sphere, std::array{BodyContact{0, 0, x, 0.5 * x, -0.5 * x, 3.0 * x}});
    CHECK(norm(stress.total() - 3.0 * outer(x, x)) == 0.0);
    CHECK(norm(stress.per_body[0] - 3.0 * outer(x, x)) == 0.0);
}

TEST_CASE("nothing touches: no stress; and lists that cannot be are refused") {
    const std::vector<Mat3> bodies(2, identity());
    CHECK(norm(contact_stress(bodies, {}).total()) == 0.0);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Vec3 x = {1, 0, 0};
    CHECK_THROWS_AS(contact_stress(bodies, std::array{BodyContact{0, 2, x, x, x, x}}), InputError);
    CHECK_THROWS_AS(contact_stress(bodies, std::array{BodyContact{0, 1, x, x, x, {0, nan, 0}}}), InputError);
    CHECK_THROWS_AS(contact_stress({}, std::array{BodyContact{0, 0, x, x, x, x}}), InputError);
    const std::vector<Mat3> line = {identity(), outer(x, x)};
    CHECK_THROWS_AS(contact_stress(line, std::array{BodyContact{0, 1, x, x, x, {0, 1, 0}}}), InputError);
}
