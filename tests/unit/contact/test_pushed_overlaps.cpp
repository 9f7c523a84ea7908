// Pairs in contact that overlap where contact forces take them.

#include <doctest/doctest.h>

#include <algorithm>

#include "jostle/contact/pushed_overlaps.hpp"

using namespace jostle;

//     j |                 i is turned about its centre by 90 degrees, into j
//     ==|== i    ->    j ||| i
TEST_CASE("a pair that is turned into overlap gets its nearest points there") {
    Rods rods;
    rods.push_back(0, {1, 1, 1}, {1, 0, 0}, 4.0, 1.0);
    rods.push_back(1, {1, 3, 1.9}, {1, 0, 0}, 4.0, 1.0);
    rods.push_back(2, {1, 1, 8}, {1, 0, 0}, 4.0, 1.0);
    const Box box = {{10, 10, 10}, {true, true, true}};
    Contacts contacts;
    const auto add = [&](std::uint32_t i, std::uint32_t j, const Image& image) {
        Contact contact;
        contact.i = i;
        contact.j = j;
        contacts.push_back(contact, image, ContactFeature::nearest);
    };
    add(0, 1, {0, 0, 0});
    add(0, 1, {0, 0, 0});
    add(0, 2, {0, 0, -1});
    const RodAfter still = [&](std::uint32_t row) { return std::pair{rods.centre[row], rods.axis[row]}; };
    CHECK(pushed_overlaps(contacts, rods, box, still, 0.01).size() == 0);

    const RodAfter turned = [&](std::uint32_t row) {
        return std::pair{rods.centre[row], row == 0 ? Vec3{0, 1, 0} : rods.axis[row]};
    };
    CHECK(pushed_overlaps(contacts, rods, box, turned, 0.11).size() == 0);
    const Contacts found = pushed_overlaps(contacts, rods, box, turned, 0.09);
    REQUIRE(found.size() == 1);
    const Contact& contact = found.contact[0];
    CHECK((contact.i == 0 && contact.j == 1));
    CHECK(found.feature[0] == ContactFeature::pushed);
    CHECK(contact.gap == doctest::Approx(-0.1));
    CHECK(contact.arm_i == doctest::Approx(2.0));
    CHECK(norm(contact.normal - Vec3{0, 0, 1}) < 1e-12);

    const RodAfter lowered = [&](std::uint32_t row) {
        return std::pair{rods.centre[row] + (row == 2 ? Vec3{0, 0, 2.5} : Vec3{}), rods.axis[row]};
    };
    const Contacts through_the_wall = pushed_overlaps(contacts, rods, box, lowered, 0.01);
    REQUIRE(through_the_wall.size() == 1);
    CHECK(through_the_wall.contact[0].room == doctest::Approx(-0.5));
    CHECK(through_the_wall.contact[0].gap == doctest::Approx(2.0));  // before the step
    CHECK(through_the_wall.image[0] == Image{0, 0, -1});

    // Pushed through each other, rods are brought back to the sides that they came from.
    for (Contact& known : contacts.contact) known.normal = {0, 0, -1};
    const RodAfter beyond = [&](std::uint32_t row) {
        return std::pair{rods.centre[row] + (row == 2 ? Vec3{0, 0, 5.25} : Vec3{}), rods.axis[row]};
    };
    const Contacts passed = pushed_overlaps(contacts, rods, box, beyond, 0.01);
    const auto other = std::find(passed.image.begin(), passed.image.end(), Image{0, 0, -1}) - passed.image.begin();
    REQUIRE(static_cast<std::size_t>(other) < passed.size());
    CHECK(norm(passed.contact[other].normal - Vec3{0, 0, -1}) < 1e-12);
    CHECK(passed.contact[other].room == doctest::Approx(-3.25));
}
