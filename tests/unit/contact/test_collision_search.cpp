#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "jostle/contact/collision_search.hpp"
#include "jostle/math/rotation.hpp"
#include "support/assemblies.hpp"

using namespace jostle;
using namespace jostle::test;

namespace {

constexpr double margin = 0.02, allowance = 0.05, touching = 0.02, travel = 0.3;

/// Random motions and pushes of some rods.
struct Moves {
    std::vector<Vec3> centre, axis, end_centre, end_axis;
    std::vector<double> displacement, touching_part;
    std::vector<Push> pushes;
    std::vector<std::uint32_t> pushed;

    Moves(const Rods& rods, double known, double push, std::mt19937_64& engine)
        : displacement(rods.size()), touching_part(rods.size(), touching), pushes(rods.size()) {
        std::normal_distribution<double> normal;
        const auto vector = [&](double size) { return size * Vec3{normal(engine), normal(engine), normal(engine)}; };
        for (std::uint32_t i = 0; i < rods.size(); ++i) {
            const double half = 0.5 * rods.length[i], lever = 1.0 + half;
            const Vec3 turn = vector(known / lever);
            centre.push_back(rods.centre[i] + vector(known));
            axis.push_back(rotated(rods.axis[i], turn));
            displacement[i] = farthest_displacement(centre[i] - rods.centre[i], axis[i] - rods.axis[i], half);
            const double size = i % 3 == 0 ? push : 0.0;  // forces push every third rod
            const Vec3 shift = vector(size), more = vector(size / lever);
            end_centre.push_back(centre[i] + shift);
            end_axis.push_back(size > 0.0 ? rotated(rods.axis[i], turn + more) : axis[i]);
            if (size == 0.0) continue;
            const Vec3 end = half * (end_axis[i] - axis[i]);
            const auto single = [](const Vec3& a) {
                return std::array{static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
            };
            pushes[i] = {single(shift), single(end),
                         static_cast<float>(1.00001 * farthest_displacement(shift, end_axis[i] - axis[i], half)),
                         1e-5F};
            pushed.push_back(i);
        }
    }
    RodMotion motion(double range = 0.0) const {
        return {centre, axis,   displacement, allowance,
                travel, margin, range,        {touching_part, [](const Contact&) { return touching; }}};
    }
};

/// All pairs whose gap is below `limit` when the rods lie elsewhere.
std::set<PairName> pairs_within(Rods rods, const Box& box, const std::vector<Vec3>& centre,
                                const std::vector<Vec3>& axis, double limit) {
    // Images are told for centres as they are in `rods`, so the displaced ones must not be wrapped.
    const auto before = brute_force_pairs(rods, box, 3.0);
    std::set<PairName> result;
    for (const auto& pair : before) {
        const Vec3 displacement = box.displacement(pair.image);
        if (pair_gap(pair_geometry(rods, pair.i, pair.j, displacement, centre, axis)) < limit)
            result.insert({static_cast<std::uint32_t>(pair.i), static_cast<std::uint32_t>(pair.j), pair.image});
    }
    return result;
}

std::set<PairName> names(const Contacts& contacts) {
    std::set<PairName> result;
    for (std::size_t l = 0; l < contacts.size(); ++l)
        result.insert({contacts.contact[l].i, contacts.contact[l].j, contacts.image[l]});
    return result;
}

}  // namespace

TEST_CASE("contacts, and the pairs missed: against brute force, in any box, with small and large pushes") {
    struct Case {
        const char* name;
        Box box;
        std::size_t count;
        double length, known, push;
    };
    const std::vector<Case> cases = {
        {"rods", {{18, 18, 18}, {true, true, true}}, 150, 5.0, 0.03, 0.03},
        {"pushed beyond the allowance", {{18, 18, 18}, {true, true, true}}, 150, 5.0, 0.03, 0.15},
        {"thinner than a rod", {{20, 3, 2.5}, {true, true, true}}, 20, 5.0, 0.03, 0.08},
        {"open", {{12, 12, 12}, {false, false, false}}, 60, 5.0, 0.05, 0.08},
        {"spheres", {{9, 9, 9}, {true, true, true}}, 200, 0.0, 0.05, 0.1},
        {"long", {{25, 25, 25}, {true, true, true}}, 60, 20.0, 0.03, 0.1},
    };
    const unsigned seed = 19;
    MESSAGE("seed ", seed);
    std::mt19937_64 engine(seed);
    std::size_t missed_in_all = 0;
    for (const Case& test : cases) {
        CAPTURE(test.name);
        const Rods rods = thrown(test.count, test.box, test.length, 1.0, engine);
        CollisionSearch search;
        for (int step = 0; step < 6; ++step) {
            const Moves moves(rods, test.known, test.push, engine);
            Contacts contacts;
            const double overlap = search.find(rods, test.box, moves.motion(), contacts);
            double deepest = 0.0;
            for (const auto& pair : brute_force_pairs(rods, test.box, 0.0)) deepest = std::max(deepest, -pair.gap);
            CHECK(overlap == doctest::Approx(deepest).epsilon(1e-12));
            const double limit = touching + margin;
            const auto expected = pairs_within(rods, test.box, moves.centre, moves.axis, limit);
            const auto found = names(contacts);
            CHECK(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
            // More than these only where rods overlap already, or have passed through each other.
            for (const PairName& name : found) {
                if (expected.count(name) > 0) continue;
                const Vec3 displacement = test.box.displacement(name.image);
                const auto before = pair_geometry(rods, name.i, name.j, displacement, rods.centre, rods.axis);
                const auto moved = pair_geometry(rods, name.i, name.j, displacement, moves.centre, moves.axis);
                const bool passed_through =
                    dot(nearest_points(before).separation, nearest_points(moved).separation) <= 0.0;
                CHECK((pair_gap(before) < 0.0 || passed_through));
            }

            const auto after = [&](std::uint32_t row) { return std::pair{moves.end_centre[row], moves.end_axis[row]}; };
            const auto missed =
                search.missed_pairs(rods, test.box, moves.motion(), contacts, moves.pushed, moves.pushes, after, true);
            std::set<PairName> touching_then = pairs_within(rods, test.box, moves.end_centre, moves.end_axis, touching);
            for (const PairName& name : found) touching_then.erase(name);
            CHECK(std::set<PairName>(missed.begin(), missed.end()) == touching_then);
            missed_in_all += missed.size();

            search.add(missed, rods, test.box, moves.motion(), contacts);
            CHECK(names(contacts).size() == found.size() + missed.size());
            CHECK(search.missed_pairs(rods, test.box, moves.motion(), contacts, moves.pushed, moves.pushes, after, true)
                      .empty());
        }
    }
    CHECK(missed_in_all > 50);  // or the test would not test the second half
}

TEST_CASE("with a range, all pairs with a smaller gap are contacts") {
    std::mt19937_64 engine(23);
    const Box box{{12, 12, 12}, {true, true, true}};
    const Rods rods = thrown(60, box, 5.0, 1.0, engine);
    const Moves moves(rods, 0.02, 0.0, engine);
    CollisionSearch search;
    Contacts contacts;
    search.find(rods, box, moves.motion(0.5), contacts);
    const auto found = names(contacts);
    for (const PairName& name : pairs_within(rods, box, rods.centre, rods.axis, 0.5)) CHECK(found.count(name) == 1);
}

TEST_CASE("what is found does not depend on when the neighbour list was built") {
    std::mt19937_64 engine(31);
    const Box box{{18, 18, 18}, {false, false, false}};
    std::size_t early = 0, late = 0;
    for (int sample = 0; sample < 50; ++sample) {
        Rods rods = thrown(500, box, 5.0, 1.0, engine);
        CollisionSearch old_search, new_search;
        Contacts contacts, contacts_of_new;
        const Moves before(rods, 0.04, 0.0, engine);
        old_search.find(rods, box, before.motion(), contacts);
        rods.centre = before.centre;
        rods.axis = before.axis;
        const Moves moves(rods, 0.03, 0.02, engine);  // half of them beyond the allowance
        const auto after = [&](std::uint32_t row) { return std::pair{moves.end_centre[row], moves.end_axis[row]}; };
        old_search.find(rods, box, moves.motion(), contacts);
        new_search.find(rods, box, moves.motion(), contacts_of_new);
        CHECK(names(contacts) == names(contacts_of_new));
        for (const bool thorough : {false, true, false}) {
            const auto missed = [&](CollisionSearch& search) {
                return search.missed_pairs(rods, box, moves.motion(), contacts, moves.pushed, moves.pushes, after,
                                           thorough);
            };
            const auto found = missed(old_search);
            CHECK(found == missed(new_search));
            (thorough ? late : early) += found.size();
        }
    }
    CHECK(early > 10);
    CHECK(late > early / 2);
}
