// Steps that begin from the contact forces of the last one.

#include <doctest/doctest.h>

#include <algorithm>

#include "jostle/contact_problem/previous_forces.hpp"
#include "jostle/rods/space_filling_order.hpp"
#include "jostle/setup/assemble.hpp"

using namespace jostle;

namespace {

void add(Contacts& contacts, std::uint32_t i, std::uint32_t j, ContactFeature feature) {
    Contact contact;
    contact.i = i;
    contact.j = j;
    contacts.push_back(contact, {}, feature);
}

Contacts three_contacts() {
    Contacts contacts;
    add(contacts, 0, 2, ContactFeature::nearest);
    add(contacts, 1, 2, ContactFeature::end_of_i);
    add(contacts, 1, 2, ContactFeature::end_of_j);
    return contacts;
}

const std::vector<std::uint64_t> ids = {2, 4, 7, 9};  ///< of the rows

/// Cells that grow into each other in open space, without noise but for what lets their line buckle.
Scene colony(WarmStarts warm_start) {
    Scene scene;
    scene.seed = 5;
    scene.rods.count = 1;
    scene.rods.length = 2.0;
    scene.fluid.kT = 0.001;
    scene.contact.brownian_correction = false;
    scene.time.step = 0.01;
    scene.growth.rate = 1.0;
    scene.growth.rate_deviation = 0.1;
    scene.growth.division_length = 5.0;
    scene.solver.warm_start = warm_start;
    return scene;
}

const Box open_space = {{1000, 1000, 1000}, {false, false, false}};

Rods one_cell() {
    Rods rods;
    rods.push_back(0, {500, 500, 500}, {1, 0, 0}, 2.0, 1.0);
    return rods;
}

}  // namespace

TEST_CASE("a contact begins with the force of the same feature of the same rods, others with none") {
    Contacts contacts = three_contacts();
    CHECK(starting_forces(contacts, ids, {}).empty());
    const auto previous = previous_forces(contacts, std::vector{1.5, 0.0, 2.5}, ids);
    CHECK(previous.size() == 2);  // forces of 0 need not be known

    add(contacts, 1, 3, ContactFeature::nearest);
    add(contacts, 0, 2, ContactFeature::end_of_i);
    CHECK(starting_forces(contacts, ids, previous) == std::vector{1.5, 0.0, 2.5, 0.0, 0.0});
}

TEST_CASE("each end of a rod has its own force") {
    Contacts contacts;
    for (const double arm : {-1.0, 1.0}) {
        add(contacts, 0, 1, ContactFeature::end_of_i);
        contacts.contact.back().arm_i = arm;
    }
    const auto previous = previous_forces(contacts, std::vector{1.5, 2.5}, ids);
    CHECK(starting_forces(contacts, ids, previous) == std::vector{1.5, 2.5});
}

TEST_CASE("forces follow their rods to other rows: they know them by ids") {
    State state;
    state.previous_forces = previous_forces(three_contacts(), std::vector{1.5, 3.5, 2.5}, ids);
    Contacts contacts;
    add(contacts, 3, 0, ContactFeature::end_of_j);  // rows of the ids 4 and 7
    CHECK(starting_forces(contacts, std::vector<std::uint64_t>{7, 0, 0, 4}, state.previous_forces) == std::vector{2.5});
    const std::vector<PreviousForce> forces = in_order_of_ids(state).previous_forces;
    CHECK(std::is_sorted(forces.begin(), forces.end(), [](const auto& a, const auto& b) { return a.i < b.i; }));
    CHECK(starting_forces(three_contacts(), ids, forces) == std::vector{1.5, 3.5, 2.5});
}

TEST_CASE("of a pair that touched in two images, the larger force counts, whichever comes first") {
    Contacts contacts;
    add(contacts, 0, 1, ContactFeature::nearest);
    add(contacts, 0, 1, ContactFeature::nearest);
    contacts.image[1] = {1, 0, 0};
    for (const auto& gamma : {std::vector{1.0, 2.0}, std::vector{2.0, 1.0}}) {
        const auto previous = previous_forces(contacts, gamma, ids);
        CHECK(starting_forces(contacts, ids, previous) == std::vector{2.0, 2.0});
    }
}

TEST_CASE("warm and cold starts find the same velocities of a dense colony, the warm one in fewer sweeps") {
    Simulation warm = assemble(colony(WarmStarts::automatic), {open_space, one_cell()});
    CHECK(warm.settings().warm_start);
    while (warm.rods().size() < 300) warm.step();
    std::uint64_t warm_sweeps = 0, cold_sweeps = 0;
    for (int step = 0; step < 20; ++step) {
        Simulation cold = assemble(colony(WarmStarts::never), {open_space, warm.rods(), warm.clock()});
        cold_sweeps += cold.step().iterations;
        warm_sweeps += warm.step().iterations;
        CHECK(cold.state().previous_forces.empty());
        const Rods a = in_order_of_ids(warm.rods()), b = in_order_of_ids(cold.rods());
        REQUIRE(a.id == b.id);
        double farthest = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) farthest = std::max(farthest, norm(a.centre[i] - b.centre[i]));
        CHECK(farthest < 1e-3);  // the tolerance is 1e-5, added up along chains of cells
    }
    MESSAGE("sweeps: ", warm_sweeps, " warm, ", cold_sweeps, " cold");
    CHECK(warm_sweeps < cold_sweeps);
}

TEST_CASE("auto begins warm without noise, or where growth is stronger") {
    Scene scene = colony(WarmStarts::automatic);
    const auto is_warm = [&] { return assemble(scene, {open_space, one_cell()}).settings().warm_start; };
    CHECK(is_warm());
    scene.fluid.kT = 1.0;
    CHECK(!is_warm());
    scene.growth = {};
    scene.fluid.kT = 0.001;
    CHECK(!is_warm());
    scene.motion.brownian = false;
    CHECK(is_warm());
    scene.solver.warm_start = WarmStarts::never;
    CHECK(!is_warm());
}
