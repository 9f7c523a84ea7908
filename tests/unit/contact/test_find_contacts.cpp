#include <doctest/doctest.h>

#include "jostle/contact/find_contacts.hpp"
#include "jostle/math/rotation.hpp"
#include "support/assemblies.hpp"

using namespace jostle;
using namespace jostle::test;

namespace {

const Box wide{{100, 100, 100}, {true, true, true}};

Contacts contacts_of(const Rods& rods, double range = 0.2, const Box& box = wide) {
    NeighbourList neighbours(0.1);
    const std::vector<double> ranges(rods.size(), 0.5 * range);
    neighbours.update(rods, box, ranges);
    Contacts contacts;
    find_contacts(rods, box, neighbours, ranges, contacts);
    return contacts;
}

Rods two_rods(const Vec3& between, const Vec3& axis_1, const Vec3& axis_2, double length = 5.0) {
    Rods rods;
    rods.push_back(0, {50, 50, 50}, normalised(axis_1), length, 1.0);
    rods.push_back(1, Vec3{50, 50, 50} + between, normalised(axis_2), length, 1.0);
    return rods;
}

}  // namespace

TEST_CASE("two spheres") {
    const auto contacts = contacts_of(two_rods({1.1, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0.0));
    REQUIRE(contacts.size() == 1);
    CHECK(contacts.contact[0].gap == doctest::Approx(0.1));
    CHECK(contacts.contact[0].normal == Vec3{1, 0, 0});
    CHECK(contacts.contact[0].arm_i == 0.0);
}

TEST_CASE("crossed rods touch once") {
    const auto contacts = contacts_of(two_rods({0.5, 0.3, 1.05}, {1, 0, 0}, {0, 1, 0}));
    REQUIRE(contacts.size() == 1);
    CHECK(contacts.contact[0].gap == doctest::Approx(0.05));
    CHECK(contacts.contact[0].arm_i == doctest::Approx(0.5));
    CHECK(contacts.contact[0].arm_j == doctest::Approx(-0.3));
    CHECK(contacts.contact[0].normal.z == doctest::Approx(1.0));
}

TEST_CASE("parallel rods side by side touch at both ends of their overlap, and only there") {
    //   i ==========          overlap from s_i = -1.5 to 2.5
    //   j    ==========
    const auto contacts = contacts_of(two_rods({1.0, 1.02, 0}, {1, 0, 0}, {1, 0, 0}));
    REQUIRE(contacts.size() == 2);
    CHECK(contacts.contact[0].arm_i == doctest::Approx(-1.5));
    CHECK(contacts.contact[0].arm_j == doctest::Approx(-2.5));
    CHECK(contacts.contact[1].arm_i == doctest::Approx(2.5));
    CHECK(contacts.contact[1].arm_j == doctest::Approx(1.5));
    for (const Contact& contact : contacts.contact) CHECK(contact.gap == doctest::Approx(0.02));
}

TEST_CASE("head-to-head rods (a cell that has just divided) touch once, at the tips") {
    const auto contacts = contacts_of(two_rods({6.0, 0, 0}, {1, 0, 0}, {1, 0, 0}));
    REQUIRE(contacts.size() == 1);
    CHECK(contacts.contact[0].gap == doctest::Approx(0.0).scale(1.0));
    CHECK(contacts.contact[0].normal.x == doctest::Approx(1.0));
    CHECK(contacts.contact[0].arm_i == doctest::Approx(2.5));
    CHECK(contacts.contact[0].arm_j == doctest::Approx(-2.5));
}

TEST_CASE("a slightly tilted pair keeps its nearest point and gets the far end") {
    const auto contacts = contacts_of(two_rods({0, 1.1, 0}, {1, 0, 0}, {1, 0.03, 0}), 0.3);
    CHECK(contacts.size() >= 2);
    double smallest = 1.0;
    for (const Contact& contact : contacts.contact) smallest = std::min(smallest, contact.gap);
    CHECK(smallest == doctest::Approx(0.1 - 2.5 * std::sin(std::atan(0.03))).epsilon(0.02));
}

TEST_CASE("crossing and coincident axes still have a normal to be pushed along") {
    for (const Vec3& second : {Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{1, 1e-12, 0}}) {
        const auto contacts = contacts_of(two_rods({0, 0, 0}, {1, 0, 0}, second));
        REQUIRE(contacts.size() >= 1);
        for (const Contact& contact : contacts.contact) {
            CHECK(norm(contact.normal) == doctest::Approx(1.0));
            CHECK(std::fabs(contact.normal.x) < 1e-6);
            CHECK(contact.gap == doctest::Approx(-1.0));
        }
    }
}

TEST_CASE(
    "gap_of_contact follows the same points: equal to the gap where nothing moved, and signed when rods pass through") {
    std::mt19937_64 engine(3);
    const Box box{{6, 6, 6}, {true, true, true}};
    const Rods rods = thrown(30, box, 4.0, 1.0, engine);
    const Contacts contacts = contacts_of(rods, 0.3, box);
    REQUIRE(contacts.size() > 50);
    for (std::size_t l = 0; l < contacts.size(); ++l)
        CHECK(gap_at(contacts, l, rods, box, rods.centre, rods.axis) ==
              doctest::Approx(contacts.contact[l].gap).epsilon(1e-10).scale(1.0));

    const Rods pair = two_rods({0, 0, 1.05}, {1, 0, 0}, {0, 1, 0});
    const Contacts crossed = contacts_of(pair);
    const std::vector<Vec3> moved = {pair.centre[0], pair.centre[0] + Vec3{0, 0, -0.25}};
    CHECK(gap_at(crossed, 0, pair, wide, moved, pair.axis) == doctest::Approx(-1.25));
}
