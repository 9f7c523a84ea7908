#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "jostle/contact/collision_search.hpp"
#include "jostle/math/rotation.hpp"
#include "support/assemblies.hpp"

using namespace jostle;
using namespace jostle::test;

namespace {

constexpr double margin = 0.02, displacement_limit = 0.05, skin = 0.3;

Vec3 random_vector(double size, std::mt19937_64& engine) {
    std::normal_distribution<double> normal;
    return size * Vec3{normal(engine), normal(engine), normal(engine)};
}

/// Random known motions of rods, and displacements of every third by forces.
struct Moves {
    const Rods& rods_before;
    const Box& in_box;
    Configuration known;
    Velocities known_velocity;  ///< in a step of 1
    std::vector<MobileRod> arms;
    std::vector<ContactVelocity> velocity;
    std::vector<double> farthest_known;
    std::vector<std::uint32_t> local_index, rows;

    Moves(const Rods& rods, const Box& box, double known_size, double forced_size, std::mt19937_64& engine)
        : rods_before(rods),
          in_box(box),
          known_velocity(rods.size()),
          farthest_known(rods.size()),
          local_index(rods.size(), no_local_index) {
        for (std::uint32_t i = 0; i < rods.size(); ++i) {
            const double half = 0.5 * rods.length[i], lever = 1.0 + half;
            const Vec3 turn = random_vector(known_size / lever, engine);
            known_velocity.linear[i] = random_vector(known_size, engine);
            known_velocity.angular[i] = turn;
            known.centre.push_back(rods.centre[i] + known_velocity.linear[i]);
            known.axis.push_back(rotated(rods.axis[i], turn));
            farthest_known[i] =
                farthest_displacement(known.centre[i] - rods.centre[i], known.axis[i] - rods.axis[i], half);
            if (forced_size == 0.0 || i % 3 != 0) continue;
            local_index[i] = static_cast<std::uint32_t>(rows.size());
            rows.push_back(i);
            arms.push_back({rods.axis[i], {}});
        }
        velocity.resize(rows.size());
        change_forces(forced_size, engine);
    }
    /// Every displacement by forces changes by about `size`.
    void change_forces(double size, std::mt19937_64& engine) {
        for (std::size_t k = 0; k < rows.size(); ++k) {
            const std::uint32_t i = rows[k];
            const double half = 0.5 * rods_before.length[i];
            velocity[k].centre += random_vector(size, engine);
            velocity[k].axis_rate += cross(random_vector(size / (1.0 + half), engine), rods_before.axis[i]);
        }
    }
    StepGeometry step(double range = 0.0, double normals_after = 0.0) const {
        return {rods_before, in_box, known, farthest_known, {displacement_limit, skin, margin, range}, normals_after};
    }
    EndConfiguration end() const {
        EndConfiguration result(rods_before, known_velocity, known, 1.0);
        result.set_velocities({local_index, rows, arms}, {velocity});
        result.find_displacements();
        return result;
    }
    Configuration all_at_end() const {
        Configuration all;
        const EndConfiguration there = end();
        for (std::uint32_t i = 0; i < known.size(); ++i) {
            all.centre.push_back(there.centre(i));
            all.axis.push_back(there.axis(i));
        }
        return all;
    }
};

/// All pairs whose gap is below `limit` when the rods lie elsewhere.
std::set<PairKey> pairs_within(Rods rods, const Box& box, const Configuration& at, double limit) {
    // Images are told for centres as they are in `rods`, so the displaced ones must not be wrapped.
    const auto before = brute_force_pairs(rods, box, 3.0);
    std::set<PairKey> result;
    for (const auto& pair : before) {
        const Vec3 displacement = box.displacement(pair.image);
        if (pair_gap(pair_geometry(rods, pair.i, pair.j, displacement, at.centre, at.axis)) < limit)
            result.insert({static_cast<std::uint32_t>(pair.i), static_cast<std::uint32_t>(pair.j), pair.image});
    }
    return result;
}

std::set<PairKey> keys(const Contacts& contacts) {
    std::set<PairKey> result;
    for (std::size_t l = 0; l < contacts.size(); ++l)
        result.insert({contacts.contact[l].i, contacts.contact[l].j, contacts.image[l]});
    return result;
}

}  // namespace

TEST_CASE("contacts, and violated pairs: against brute force, in any box, with small and large displacements") {
    struct Case {
        const char* name;
        Box box;
        std::size_t count;
        double length, known, forced;
    };
    const std::vector<Case> cases = {
        {"rods", {{18, 18, 18}, {true, true, true}}, 150, 5.0, 0.03, 0.03},
        {"displaced beyond the limit", {{18, 18, 18}, {true, true, true}}, 150, 5.0, 0.03, 0.15},
        {"thinner than a rod", {{20, 3, 2.5}, {true, true, true}}, 20, 5.0, 0.03, 0.08},
        {"open", {{12, 12, 12}, {false, false, false}}, 60, 5.0, 0.05, 0.08},
        {"spheres", {{9, 9, 9}, {true, true, true}}, 200, 0.0, 0.05, 0.1},
        {"long", {{25, 25, 25}, {true, true, true}}, 60, 20.0, 0.03, 0.1},
    };
    const unsigned seed = 19;
    MESSAGE("seed ", seed);
    std::mt19937_64 engine(seed);
    std::size_t violated_in_all = 0;
    for (const Case& test : cases) {
        CAPTURE(test.name);
        const Rods rods = thrown(test.count, test.box, test.length, 1.0, engine);
        CollisionSearch search;
        for (int step = 0; step < 6; ++step) {
            const Moves moves(rods, test.box, test.known, test.forced, engine);
            Contacts contacts;
            const double overlap = search.find(moves.step(), contacts);
            double deepest = 0.0;
            for (const auto& pair : brute_force_pairs(rods, test.box, 0.0)) deepest = std::max(deepest, -pair.gap);
            CHECK(overlap == doctest::Approx(deepest).epsilon(1e-12));
            const auto expected = pairs_within(rods, test.box, moves.known, margin);
            const auto found = keys(contacts);
            CHECK(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
            // More than these only where rods overlap already, or have passed through each other.
            for (const PairKey& key : found) {
                if (expected.count(key) > 0) continue;
                const Vec3 displacement = test.box.displacement(key.image);
                const auto before = pair_geometry(rods, key.i, key.j, displacement, rods.centre, rods.axis);
                const auto moved =
                    pair_geometry(rods, key.i, key.j, displacement, moves.known.centre, moves.known.axis);
                const bool passed_through =
                    dot(nearest_points(before).separation, nearest_points(moved).separation) <= 0.0;
                CHECK((pair_gap(before) < 0.0 || passed_through));
            }

            const auto violated = search.violated_pairs(moves.step(), contacts, moves.end());
            std::set<PairKey> touching_then = pairs_within(rods, test.box, moves.all_at_end(), 0.0);
            for (const PairKey& key : found) touching_then.erase(key);
            CHECK(std::set<PairKey>(violated.begin(), violated.end()) == touching_then);
            violated_in_all += violated.size();

            contacts.append(search.activate(violated, moves.step()));
            CHECK(keys(contacts).size() == found.size() + violated.size());
            CHECK(search.violated_pairs(moves.step(), contacts, moves.end()).empty());
        }
    }
    CHECK(violated_in_all > 20);  // or the test would not test the second half
}

TEST_CASE("violated pairs of forces that change from search to search: against brute force") {
    const Box box{{18, 18, 18}, {true, true, true}};
    std::mt19937_64 engine(37);
    const Rods rods = thrown(300, box, 5.0, 1.0, engine);
    CollisionSearch search;
    std::size_t found_late = 0;
    for (int step = 0; step < 8; ++step) {
        Moves moves(rods, box, 0.03, 0.02, engine);
        Contacts contacts;
        search.find(moves.step(), contacts);
        // From below the displacement limit to beyond it, now of a few rods and now of many; by 0.3 the list is built
        // anew within the step.
        for (const double change : {0.0, 0.01, 0.03, 0.005, 0.06, 0.01, 0.3, 0.01}) {
            moves.change_forces(change, engine);
            const auto violated = search.violated_pairs(moves.step(), contacts, moves.end());
            auto expected = pairs_within(rods, box, moves.all_at_end(), 0.0);
            for (const PairKey& key : keys(contacts)) expected.erase(key);
            CHECK(std::set<PairKey>(violated.begin(), violated.end()) == expected);
            contacts.append(search.activate(violated, moves.step()));
            found_late += change > 0.0 ? violated.size() : 0;
        }
    }
    CHECK(found_late > 100);
}

TEST_CASE("with a range, all pairs with a smaller gap are contacts") {
    std::mt19937_64 engine(23);
    const Box box{{12, 12, 12}, {true, true, true}};
    const Rods rods = thrown(60, box, 5.0, 1.0, engine);
    const Moves moves(rods, box, 0.02, 0.0, engine);
    CollisionSearch search;
    Contacts contacts;
    search.find(moves.step(0.5), contacts);
    const auto found = keys(contacts);
    for (const PairKey& key : pairs_within(rods, box, {rods.centre, rods.axis}, 0.5)) CHECK(found.count(key) == 1);
}

TEST_CASE("what is found does not depend on when the neighbour list was built") {
    std::mt19937_64 engine(31);
    const Box box{{18, 18, 18}, {false, false, false}};
    std::size_t found_count = 0;
    for (int sample = 0; sample < 50; ++sample) {
        Rods rods = thrown(500, box, 5.0, 1.0, engine);
        CollisionSearch old_search, new_search;
        Contacts contacts, contacts_of_new;
        const Moves before(rods, box, 0.04, 0.0, engine);
        old_search.find(before.step(), contacts);
        rods.centre = before.known.centre;
        rods.axis = before.known.axis;
        const Moves moves(rods, box, 0.03, 0.02, engine);  // half of them beyond the limit
        old_search.find(moves.step(), contacts);
        new_search.find(moves.step(), contacts_of_new);
        CHECK(keys(contacts) == keys(contacts_of_new));
        for (int search = 0; search < 2; ++search) {  // the second knows how wide gaps were at the first
            const auto found = old_search.violated_pairs(moves.step(), contacts, moves.end());
            CHECK(found == new_search.violated_pairs(moves.step(), contacts, moves.end()));
            found_count += found.size();
        }
    }
    CHECK(found_count > 20);
}
