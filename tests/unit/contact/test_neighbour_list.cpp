#include <doctest/doctest.h>

#include <set>
#include <tuple>

#include "jostle/contact/find_contacts.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/math/rotation.hpp"
#include "support/assemblies.hpp"

using namespace jostle;
using namespace jostle::test;

namespace {

using Key = std::tuple<std::size_t, std::size_t, Image>;

std::set<Key> keys(const std::vector<BrutePair>& pairs) {
    std::set<Key> result;
    for (const auto& pair : pairs) result.emplace(pair.i, pair.j, pair.image);
    return result;
}

std::set<Key> keys(const Contacts& contacts) {
    std::set<Key> result;
    for (std::size_t l = 0; l < contacts.size(); ++l)
        result.emplace(contacts.contact[l].i, contacts.contact[l].j, contacts.image[l]);
    return result;
}

void walk(Rods& rods, const Box& box, double step, std::mt19937_64& engine) {
    std::normal_distribution<double> normal(0.0, step);
    for (std::size_t i = 0; i < rods.size(); ++i) {
        rods.centre[i] += Vec3{normal(engine), normal(engine), normal(engine)};
        box.wrap(rods.centre[i], rods.image[i]);
        const double lever = 1.0 + 0.5 * rods.length[i];  // tips move about as far as centres
        rods.axis[i] = rotated(rods.axis[i], Vec3{normal(engine), normal(engine), normal(engine)} / lever);
    }
}

}  // namespace

TEST_CASE("no pair within range is missed, in any box, while rods move: against brute force") {
    const unsigned seed = 7;
    MESSAGE("seed ", seed);
    std::mt19937_64 engine(seed);
    struct Case {
        const char* name;
        Box box;
        std::size_t count;
        double length;
        double flung = 0.0;  ///< four rods, in pairs, so far away
    };
    const std::vector<Case> cases = {
        {"roomy", {{30, 30, 30}, {true, true, true}}, 150, 5.0},
        {"thinner than two rods", {{9, 8, 11}, {true, true, true}}, 40, 5.0},
        {"thinner than one rod", {{20, 3, 2.5}, {true, true, true}}, 20, 5.0},
        {"as thin as a diameter", {{12, 1.0, 1.0}, {true, true, true}}, 8, 5.0},
        {"open", {{15, 15, 15}, {false, false, false}}, 60, 5.0},
        {"open, a few far away", {{20, 20, 20}, {false, false, false}}, 300, 2.0, 1e9},
        {"slit", {{15, 15, 4}, {true, true, false}}, 60, 5.0},
        {"spheres", {{10, 10, 10}, {true, true, true}}, 200, 0.0},
        {"long", {{25, 25, 25}, {true, true, true}}, 60, 20.0},
        {"sheared", Box({30, 30, 30}).sheared(4.0), 150, 5.0},
        {"sheared back", Box({20, 15, 30}).sheared(-7.3), 100, 5.0},
        {"sheared by half an edge", Box({10, 10, 10}).sheared(5.0), 200, 0.0},
        {"sheared, thinner than two rods", Box({9, 8, 11}).sheared(2.9), 40, 5.0},
        {"sheared, thinner than one rod", Box({20, 3, 2.5}).sheared(9.1), 20, 5.0},
        {"sheared, as thin as a diameter", Box({1.0, 1.0, 12}).sheared(0.4), 8, 5.0},
        {"sheared, planes across z", Box({15, 15, 4}, {true, true, false}).sheared(1e-9), 60, 5.0},
    };
    for (const Case& test : cases) {
        CAPTURE(test.name);
        Rods rods = thrown(test.count, test.box, test.length, 1.0, engine);
        // All into one of the outermost cells, where float would tear the last two apart.
        for (std::size_t i = 0; i < 4 && test.flung > 0.0; ++i) {
            const double beside = i % 2 == 0 ? 0.0 : 0.65;
            rods.centre[i] = {(i < 2 ? test.flung : 2.0 * test.flung + 31.9) + beside, 10.0, 10.0 + beside};
        }
        NeighbourList neighbours(0.3);
        Contacts contacts;
        int built = 0;
        for (int step = 0; step < 8; ++step) {
            std::vector<double> ranges(rods.size());
            std::uniform_real_distribution<double> uniform(0.0, 0.15);
            for (double& value : ranges) value = uniform(engine);
            built += neighbours.update(rods, test.box, ranges) ? 1 : 0;
            const double overlap = find_contacts(rods, test.box, neighbours, ranges, contacts);

            std::set<Key> expected;
            double deepest = 0.0;
            for (const auto& pair : brute_force_pairs(rods, test.box, 0.3)) {
                if (pair.gap < ranges[pair.i] + ranges[pair.j]) expected.emplace(pair.i, pair.j, pair.image);
                deepest = std::max(deepest, -pair.gap);
            }
            CHECK(keys(contacts) == expected);
            CHECK(overlap == doctest::Approx(deepest).epsilon(1e-12));
            walk(rods, test.box, 0.02, engine);
        }
        CHECK(built < 8);  // the list is reused, or the test would not test its skin
    }
}

TEST_CASE("pairs within reach are known while the box is sheared from step to step, through many of its edges") {
    std::mt19937_64 engine(17);
    for (const double length : {0.0, 5.0}) {
        const double strain = 2e-3;
        Box box = Box({14, 13, 12}).sheared(-6.9);
        Rods rods = thrown(80, box, length, 1.0, engine);
        const std::vector<double> range(rods.size(), 0.05);
        NeighbourList kept(0.4);
        int built = 0, jumps = 0;
        for (int step = 0; step < 1200; ++step) {
            built += kept.update(rods, box, range) ? 1 : 0;
            if (step % 7 == 0) {
                NeighbourList anew(0.1);
                anew.update(rods, box, range);
                Contacts from_kept, from_new;
                find_contacts(rods, box, kept, range, from_kept);
                find_contacts(rods, box, anew, range, from_new);
                REQUIRE(keys(from_kept) == keys(from_new));
            }
            const double further = box.offset() + strain * box.edges().y;
            box = box.sheared(further);
            const auto copies = static_cast<std::int32_t>(std::lround((further - box.offset()) / box.edges().x));
            jumps += copies != 0 ? 1 : 0;
            kept.shear(strain, copies);
            for (std::size_t i = 0; i < rods.size(); ++i) {
                rods.centre[i].x += strain * rods.centre[i].y;
                rods.image[i][0] += copies * rods.image[i][1];
                box.wrap(rods.centre[i], rods.image[i]);
            }
            walk(rods, box, 0.004, engine);
        }
        CHECK(jumps == 2);
        CHECK(built < 300);  // the list is reused
    }
}

TEST_CASE("a rod meets another through two images, and its own image") {
    // A box two diameters thin: a rod across the thin direction touches its neighbour on both sides.
    const Box box{{10, 10, 2.0}, {true, true, true}};
    Rods rods;
    rods.push_back(0, {2, 2, 0.5}, {1, 0, 0}, 3.0, 1.0);
    rods.push_back(1, {2, 2, 1.5}, {1, 0, 0}, 3.0, 1.0);
    const auto pairs = keys(brute_force_pairs(rods, box, 0.1));
    CHECK(pairs == std::set<Key>{{0, 1, {0, 0, 0}}, {0, 1, {0, 0, -1}}});
    NeighbourList neighbours(0.2);
    const std::vector<double> ranges{0.05, 0.05};
    neighbours.update(rods, box, ranges);
    Contacts contacts;
    find_contacts(rods, box, neighbours, ranges, contacts);
    CHECK(keys(contacts) == pairs);

    rods = {};
    rods.push_back(0, {5, 5, 1.0}, {0, 0, 1}, 1.0, 1.0);  // total length 2 along the edge of 2: it touches itself
    neighbours.update(rods, box, {ranges.data(), 1});
    find_contacts(rods, box, neighbours, {ranges.data(), 1}, contacts);
    REQUIRE(contacts.size() == 1);
    CHECK(contacts.image[0] == Image{0, 0, 1});
    CHECK(contacts.contact[0].gap == doctest::Approx(0.0).epsilon(1e-14).scale(1.0));
}

TEST_CASE("contacts do not depend on when the list was built") {
    std::mt19937_64 engine(11);
    const Box box{{9, 8, 7}, {true, true, true}};
    Rods rods = thrown(60, box, 5.0, 1.0, engine);
    const std::vector<double> ranges(rods.size(), 0.1);
    NeighbourList old_list(0.5);
    old_list.update(rods, box, ranges);
    for (int step = 0; step < 5; ++step) walk(rods, box, 0.02, engine);
    CHECK_FALSE(old_list.update(rods, box, ranges));
    NeighbourList new_list(0.2);
    new_list.update(rods, box, ranges);
    Contacts from_old, from_new;
    find_contacts(rods, box, old_list, ranges, from_old);
    find_contacts(rods, box, new_list, ranges, from_new);
    REQUIRE(from_old.size() == from_new.size());
    for (std::size_t l = 0; l < from_old.size(); ++l) {
        CHECK(from_old.image[l] == from_new.image[l]);
        CHECK(from_old.contact[l].gap == from_new.contact[l].gap);  // bit for bit
        CHECK(from_old.contact[l].normal == from_new.contact[l].normal);
    }
}

TEST_CASE("a rod that winds through a tiny box again and again is refused, not listed wrongly") {
    Rods rods;
    rods.push_back(0, {}, {1, 0, 0}, 60.0, 1.0);
    const std::vector<double> ranges(1, 0.1);
    NeighbourList neighbours(0.1);
    CHECK_THROWS_AS(neighbours.update(rods, {{2, 2, 2}, {true, true, true}}, ranges), InputError);
    CHECK_NOTHROW(neighbours.update(rods, {{2, 70, 70}, {true, true, true}}, ranges));
}
