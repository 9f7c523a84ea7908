#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <memory>

#include "jostle/contact/fixed_rod_search.hpp"
#include "jostle/contact/gap_drift.hpp"
#include "jostle/contact/pair_contacts.hpp"
#include "jostle/contact/wall_contacts.hpp"
#include "jostle/math/rotation.hpp"
#include "support/two_rods.hpp"

using namespace jostle;

namespace {

const std::vector<RodMobility> mobility = {{0.7, 0.5, 0.11}, {0.9, 0.6, 0.2}};

/// tr(M grad grad gap) by differences: for every rod along and across its axis, and about two axes across it.
double by_differences(const Rods& rods, const std::function<double(const Rods&)>& gap) {
    const double h = 1e-3;
    double sum = 0.0;
    const auto add = [&](double mobility_of_move, const std::function<Rods(double)>& moved) {
        sum += mobility_of_move * (gap(moved(h)) + gap(moved(-h)) - 2.0 * gap(rods)) / (h * h);
    };
    for (std::size_t row = 0; row < rods.size(); ++row) {
        const Vec3 axis = rods.axis[row], first = any_perpendicular(axis), second = cross(axis, first);
        for (const Vec3& direction : {axis, first, second})
            add(dot(direction, axis) > 0.5 ? mobility[row].parallel : mobility[row].perpendicular, [&](double by) {
                Rods moved = rods;
                moved.centre[row] += by * direction;
                return moved;
            });
        for (const Vec3& about : {first, second})
            add(mobility[row].rotational, [&](double by) {
                Rods moved = rods;
                moved.axis[row] = rotated(axis, by * about);
                return moved;
            });
    }
    return sum;
}

Contacts contacts_of(const Rods& rods) {
    const PairGeometry pair = test::first_pair(rods);
    const NearestPoints nearest = nearest_points(pair);
    Contacts contacts;
    append_contacts({0, 1, {}}, pair, nearest, norm(nearest.separation), 1.0, 3, contacts);
    return contacts;
}

double gap_of(const Rods& rods) {
    return pair_gap(test::first_pair(rods));
}

const Box open{{40, 40, 40}, {false, false, false}};

}  // namespace

TEST_CASE("how fast noise opens a gap is the trace of M times its second derivatives: side by side, at ends") {
    struct Case {
        const char* name;
        Rods rods;
    };
    for (const auto& [name, rods] :
         {Case{"side and side", test::two_rods({0.2, 0.3, 1.0}, {1, 0.1, 0}, {0.1, 1, 0})},
          Case{"end and side", test::two_rods({0.3, 2.5, 0.1}, {1, 0, 0}, {0.4, 1, 0.3})},
          Case{"side and end", test::two_rods({3.0, -0.2, 0.1}, {1, 0, 0.2}, {0.3, 1, 0.3})},
          Case{"end and end", test::two_rods({3.7, 0.6, 0.3}, {1, 0, 0.1}, {1, 0.5, 0.3})}}) {
        CAPTURE(name);
        const Contacts contacts = contacts_of(rods);
        REQUIRE(contacts.size() == 1);
        Rods touching = rods;  // the formula is that of rods that touch
        const double distance = contacts.contact[0].gap + 1.0;
        touching.diameter = {distance, distance};
        const GapDrift drift(touching, {touching.axis}, open, mobility);
        CHECK(drift(contacts.contact[0], {}) == doctest::Approx(by_differences(touching, gap_of)).epsilon(1e-4));
    }
}

TEST_CASE("the same at planes, in a sphere and in a tube, and at a fixed rod") {
    const std::vector<Box> boxes = {{{20, 20, 20}, {true, true, false}, {{false, false, true}}},
                                    {{20, 20, 20}, {false, false, false}, {{}, Container::sphere}},
                                    {{20, 20, 20}, {false, false, true}, {{}, Container::tube, 2}}};
    for (const Box& box : boxes) {
        CAPTURE(static_cast<int>(box.walls().container));
        Rods rods;
        rods.push_back(0, {11.0, 12.0, 1.5}, normalised({0.3, 0.2, -1.0}), 3.0, 1.0);
        if (box.walls().container == Container::tube) rods.centre[0] = {17.0, 12.0, 5.0};
        if (box.walls().container == Container::tube) rods.axis[0] = normalised({1.0, 0.2, 0.4});
        for (const Wall& wall : walls_of(box)) {
            if (wall.number == 5) continue;
            const double arm = dot(wall.inwards(rods.centre[0]), rods.axis[0]) < 0.0 ? 1.5 : -1.5;
            // Of a container, at the distance from its middle at which the rod touches.
            const auto gap = [&](const Rods& at) {
                return wall.distance(at.centre[0] + arm * at.axis[0]) - 0.5 * at.diameter[0];
            };
            Rods touching = rods;
            touching.diameter[0] += 2.0 * gap(rods);
            const Contact contact = contact_with_wall(wall, touching, 0, arm);
            const GapDrift drift(touching, {touching.axis}, box, mobility);
            CHECK(drift(contact, {}) == doctest::Approx(by_differences(touching, gap)).epsilon(1e-4));
        }
    }
    Rods fixed;
    fixed.push_back(0, {5, 5, 5}, {1, 0, 0}, 4.0, 1.0);
    const Box pillar = open.with_fixed_rods(std::make_shared<const Rods>(fixed));
    Rods rods;
    rods.push_back(0, {5.3, 7.0, 5.1}, normalised({0.4, 1, 0.3}), 2.0, 1.0);
    Contacts contacts;
    const std::vector<double> range{3.0};
    append_fixed_rod_contacts(rods, pillar, range, contacts);
    REQUIRE(contacts.size() == 1);
    const auto gap = [&](const Rods& at) {
        return pair_gap(pair_with(fixed, copy_of(contacts.contact[0], {}, pillar), at, 0, at.centre[0], at.axis[0]));
    };
    Rods touching = rods;
    touching.diameter[0] += 2.0 * contacts.contact[0].gap;
    const GapDrift drift(touching, {touching.axis}, pillar, mobility);
    CHECK(drift(contacts.contact[0], {}) == doctest::Approx(by_differences(touching, gap)).epsilon(1e-4));
}
