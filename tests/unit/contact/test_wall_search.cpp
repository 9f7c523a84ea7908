#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "jostle/contact/wall_contacts.hpp"
#include "jostle/contact/wall_search.hpp"
#include "jostle/mobility/drag.hpp"
#include "support/assemblies.hpp"

using namespace jostle;

namespace {

const Box slit{{20, 20, 8}, {true, true, false}, {{false, false, true}}};
const Box closed{{9, 8, 7}, {false, false, false}, {{true, true, true}}};
const Box sphere{{8, 8, 8}, {false, false, false}, {{}, Container::sphere}};
const Box tube{{20, 6, 6}, {true, false, false}, {{}, Container::tube, 0}};
const Box closed_tube{{20, 6, 6}, {false, false, false}, {{true, false, false}, Container::tube, 0}};

/// The least distance of any of many points along a rod from the surfaces that a box of this kind has, by definition.
double least_distance(const Box& box, const Vec3& centre, const Vec3& axis, double length) {
    double least = INFINITY;
    for (int k = -50; k <= 50; ++k) {
        const Vec3 x = centre + (0.01 * k * length) * axis;
        for (int a = 0; a < 3; ++a)
            if (box.walls().faces[static_cast<std::size_t>(a)]) least = std::min({least, x[a], box.edges()[a] - x[a]});
        const Vec3 d = x - 0.5 * box.edges();
        if (box.walls().container == Container::sphere) least = std::min(least, 0.5 * box.edges().x - norm(d));
        if (box.walls().container == Container::tube)
            least = std::min(least, 0.5 * box.edges().y - std::hypot(d.y, d.z));
    }
    return least;
}

}  // namespace

TEST_CASE("a rod is nearest to each kind of wall at an end, inside and outside") {
    const unsigned seed = 3;
    CAPTURE(seed);
    std::mt19937_64 engine(seed);
    for (const Box& box : {slit, closed, sphere, tube, closed_tube}) {
        const Rods rods = test::thrown(200, box, 5.0, 1.0, engine);
        const std::vector<double> ranges(rods.size(), 0.3);
        Contacts contacts;
        append_wall_contacts(rods, box, ranges, contacts);
        std::vector<double> gap(rods.size(), INFINITY);
        for (const Contact& contact : contacts.contact) {
            CHECK(is_fixed(contact.i));
            CHECK(norm(contact.normal) == doctest::Approx(1.0));
            gap[contact.j] = std::min(gap[contact.j], contact.gap);
        }
        for (std::size_t i = 0; i < rods.size(); ++i) {
            const double nearest =
                least_distance(box, rods.centre[i], rods.axis[i], rods.length[i]) - 0.5 * rods.diameter[i];
            if (nearest < 0.3)
                CHECK(gap[i] == doctest::Approx(nearest).epsilon(1e-12).scale(1.0));
            else
                CHECK(gap[i] == INFINITY);
        }
    }
}

TEST_CASE("normals of walls are the gradients of the gaps") {
    const unsigned seed = 4;
    CAPTURE(seed);
    std::mt19937_64 engine(seed);
    for (const Box& box : {closed, sphere, closed_tube})
        for (const Wall& wall : walls_of(box))
            for (int k = 0; k < 50; ++k) {
                const Vec3 x = 0.5 * box.edges() + 2.0 * test::random_direction(engine);
                const Vec3 step = 1e-6 * test::random_direction(engine);
                const double change = wall.distance(x + step) - wall.distance(x - step);
                CHECK(change == doctest::Approx(2.0 * dot(wall.inwards(x), step)).epsilon(1e-5).scale(1e-6));
            }
}

TEST_CASE(
    "areas of walls and the volume between them belong together: moving a wall by dx changes the volume by A dx") {
    const double pi = std::numbers::pi;
    CHECK(sphere.volume() == doctest::Approx(4.0 / 3.0 * pi * 64.0));
    CHECK(area_of(walls_of(sphere)[0], sphere) == doctest::Approx(4.0 * pi * 16.0));
    CHECK(closed_tube.volume() == doctest::Approx(pi * 9.0 * 20.0));
    const auto of_tube = walls_of(closed_tube);
    CHECK(area_of(of_tube[0], closed_tube) == doctest::Approx(pi * 9.0));
    CHECK(area_of(of_tube[2], closed_tube) == doctest::Approx(2.0 * pi * 3.0 * 20.0));
    CHECK(area_of(walls_of(closed)[3], closed) == doctest::Approx(9.0 * 7.0));
}

TEST_CASE("ends that only contact forces bring to a wall are found at the end of the step, once") {
    // A rod along z, its lower end 0.4 above the lower plane; a force takes it down by 0.5 in the step.
    Rods rods;
    rods.push_back(0, {1, 1, 3.4}, {0, 0, 1}, 5.0, 1.0);
    Configuration known;
    known.resize(1);
    known.centre[0] = rods.centre[0];
    known.axis[0] = rods.axis[0];
    const std::vector<double> none{0.0};
    const StepGeometry step = {rods, slit, known, none, {0.2, 0.0, 0.02, 0.0}};
    WallSearch search;
    Contacts contacts;
    CHECK(search.find(step, contacts) == 0.0);
    CHECK(contacts.size() == 0);

    Velocities still;
    still.resize(1);
    const std::vector<std::uint32_t> local_index{0}, rows{0};
    const std::vector<MobileRod> arms{{rods.axis[0], {}}};
    const std::vector<ContactVelocity> velocity{{{0, 0, -50.0}, {}}};
    EndConfiguration end(rods, still, known, 0.01);
    end.set_velocities({local_index, rows, arms}, {velocity});
    end.find_displacements();
    const Contacts found = search.violated(step, end);
    REQUIRE(found.size() == 1);
    CHECK(found.contact[0].i == fixed_body(4));
    CHECK(found.contact[0].arm_j == -2.5);
    CHECK(found.contact[0].gap == doctest::Approx(0.4));
    CHECK(found.contact[0].normal == Vec3{0, 0, 1});
    CHECK(search.violated(step, end).size() == 0);
}

TEST_CASE("a rod that lies on a plane touches it at both ends, and at its middle where walls turn no rod") {
    Rods rods;
    rods.push_back(0, {1, 1, 0.5}, {1, 0, 0}, 5.0, 1.0);
    const std::vector<double> ranges{0.1};
    Contacts contacts;
    append_wall_contacts(rods, slit, ranges, contacts);
    REQUIRE(contacts.size() == 2);
    CHECK(contacts.contact[0].arm_j == -2.5);
    CHECK(contacts.contact[1].arm_j == 2.5);
    const Box without_torque{{20, 20, 8}, {true, true, false}, {{false, false, true}, Container::none, 0, false}};
    contacts.clear();
    append_wall_contacts(rods, without_torque, ranges, contacts);
    REQUIRE(contacts.size() == 1);
    CHECK(contacts.contact[0].arm_j == 0.0);
}
