// Contacts of rods in two dimensions: no normal points out of the plane, also where axes cross, touch or coincide.

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "jostle/contact/own_image.hpp"
#include "jostle/contact/pair_contacts.hpp"

using namespace jostle;

namespace {

Vec3 in_plane(double angle) {
    return {std::cos(angle), std::sin(angle), 0.0};
}

Contacts contacts_of(const PairGeometry& pair) {
    Contacts contacts;
    const NearestPoints nearest = nearest_points(pair);
    append_contacts({0, 1, {0, 0, 0}}, pair, nearest, norm(nearest.separation), 0.1, 2, contacts);
    return contacts;
}

}  // namespace

TEST_CASE("rods whose axes cross are pushed apart in the plane, the shortest way") {
    std::mt19937_64 engine(31);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    int crossing = 0;
    for (int k = 0; k < 20000; ++k) {
        const PairGeometry pair = {{2.0 * uniform(engine), 2.0 * uniform(engine), 0.0},
                                   in_plane(std::numbers::pi * uniform(engine)),
                                   in_plane(std::numbers::pi * uniform(engine)),
                                   1.0 + uniform(engine),
                                   1.0 + uniform(engine),
                                   0.8};
        const NearestPoints nearest = nearest_points(pair);
        const Contacts contacts = contacts_of(pair);
        for (const Contact& contact : contacts.contact) {
            CHECK(contact.normal.z == 0.0);
            CHECK(norm(contact.normal) == doctest::Approx(1.0));
            CHECK(std::fabs(contact.arm_i) <= pair.half_i);
            CHECK(std::fabs(contact.arm_j) <= pair.half_j);
        }
        if (norm(nearest.separation) > 1e-9) continue;
        ++crossing;
        REQUIRE(contacts.size() == 1);
        const Contact& contact = contacts.contact[0];
        // Drawn back by its overlap the pair just touches, or is farther apart where an end lies beyond the other's.
        PairGeometry apart = pair;
        apart.centre_separation += -contact.gap * contact.normal;
        CHECK(pair_gap(apart) > -1e-9);
        const double sine = norm(cross(pair.axis_i, pair.axis_j));
        const double least = std::min(pair.half_i - std::fabs(nearest.s_i), pair.half_j - std::fabs(nearest.s_j));
        CHECK(contact.gap == doctest::Approx(-pair.radii - least * sine));
    }
    CHECK(crossing > 2000);
}

TEST_CASE("rods whose axes coincide, and spheres at one place, are pushed apart in the plane") {
    const Vec3 axis = in_plane(0.3);
    for (const PairGeometry& pair : {PairGeometry{{}, axis, axis, 2.0, 1.0, 1.0},
                                     {0.5 * axis, axis, -axis, 2.0, 1.0, 1.0},
                                     {{}, axis, in_plane(1.0), 0.0, 0.0, 1.0},
                                     {{}, axis, axis, 0.0, 0.0, 1.0}})
        for (const Contact& contact : contacts_of(pair).contact) {
            CHECK(contact.normal.z == 0.0);
            CHECK(norm(contact.normal) == doctest::Approx(1.0));
            CHECK(contact.gap == -1.0);
        }
}

TEST_CASE("a rod beside its own image is turned in the plane, also where it points at it") {
    for (const double edge : {2.0, 4.0, 5.5}) {
        const PairGeometry pair = {{edge, 0, 0}, {1, 0, 0}, {1, 0, 0}, 2.5, 2.5, 1.0};
        const auto contact = contact_with_own_image({0, 0, {1, 0, 0}}, pair);
        REQUIRE(contact.has_value());
        CHECK(contact->normal.z == 0.0);
    }
}
