// Pairs in contact that overlap where contact forces take them.

#include <doctest/doctest.h>

#include <algorithm>

#include "jostle/contact/relinearised_contacts.hpp"

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
    const std::vector<std::uint32_t> local_index(3, no_local_index);
    const Velocities velocity(3);
    const auto overlaps = [&](const Configuration& end, double max_overlap) {
        EndConfiguration without_forces(rods, velocity, end, 1.0);
        without_forces.set_velocities({local_index, {}, {}}, {});
        return relinearised_contacts(contacts, box, without_forces, max_overlap);
    };
    const Configuration still = {rods.centre, rods.axis};
    CHECK(overlaps(still, 0.01).size() == 0);

    Configuration turned = still;
    turned.axis[0] = {0, 1, 0};
    CHECK(overlaps(turned, 0.11).size() == 0);
    const Contacts found = overlaps(turned, 0.09);
    REQUIRE(found.size() == 1);
    const Contact& contact = found.contact[0];
    CHECK((contact.i == 0 && contact.j == 1));
    CHECK(found.feature[0] == ContactFeature::relinearised);
    CHECK(contact.gap == doctest::Approx(-0.1));
    CHECK(contact.arm_i == doctest::Approx(2.0));
    CHECK(norm(contact.normal - Vec3{0, 0, 1}) < 1e-12);

    Configuration lowered = still;
    lowered.centre[2] += {0, 0, 2.5};
    const Contacts through_the_wall = overlaps(lowered, 0.01);
    REQUIRE(through_the_wall.size() == 1);
    CHECK(through_the_wall.contact[0].gap_after == doctest::Approx(-0.5));
    CHECK(through_the_wall.contact[0].gap == doctest::Approx(2.0));  // before the step
    CHECK(through_the_wall.image[0] == Image{0, 0, -1});

    // Pushed through each other, rods are brought back to the sides that they came from.
    for (Contact& known : contacts.contact) known.normal = {0, 0, -1};
    Configuration beyond = still;
    beyond.centre[2] += {0, 0, 5.25};
    const Contacts passed = overlaps(beyond, 0.01);
    const auto other = std::find(passed.image.begin(), passed.image.end(), Image{0, 0, -1}) - passed.image.begin();
    REQUIRE(static_cast<std::size_t>(other) < passed.size());
    CHECK(norm(passed.contact[other].normal - Vec3{0, 0, -1}) < 1e-12);
    CHECK(passed.contact[other].gap_after == doctest::Approx(-3.25));
}
