// What several ranks measure together has the bits of what one process measures: rows, contacts, fields, stress of each
// rod, checkpoints. Ranks are threads here.

#include <doctest/doctest.h>

#include <cstring>
#include <string>
#include <vector>

#include "jostle/measurement/measurement.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/stress/stress_per_rod.hpp"
#include "support/first_rank.hpp"
#include "support/simulations.hpp"

using namespace jostle;

namespace {

/// As the first rank has it.
struct Measured {
    TableRows series, contacts, field;
    std::vector<Mat3> stress_of_rods;
    std::vector<std::string> checkpoints;
};

/// nan is the same as nan: an active stress that is not known yet.
bool same_bits(const TableRows& a, const TableRows& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t k = 0; k < a.size(); ++k)
        if (a[k].size() != b[k].size() || std::memcmp(a[k].data(), b[k].data(), a[k].size() * sizeof(double)) != 0)
            return false;
    return true;
}

Measured measured(const Scene& scene, const State& start, int steps, const Ranks& ranks) {
    Simulation simulation = assemble(scene, start);
    Measurement measurement(scene, simulation);
    measurement.share(ranks);
    simulation.share(ranks);
    Measured all;
    for (int k = 0; k < steps; ++k) {
        if (k % 4 == 1) simulation.rebalance();
        const Due due = measurement.add(simulation.step(), simulation);
        if (due.row) {
            all.series.push_back(measurement.last_row());
            for (auto& row : contact_rows(contact_columns(scene), simulation)) all.contacts.push_back(std::move(row));
        }
        if (due.field)
            for (const auto& row : measurement.last_field()) all.field.push_back(row);
        if (due.checkpoint) {
            const CollisionMoments moments = at_first_rank(simulation.collision_moments(), ranks);
            const RodsInOrder rods = simulation.rods_in_order();
            all.checkpoints.push_back(packed(checkpoint_without_rods(simulation, measurement.sums(), "scene"), rods));
            all.stress_of_rods = stress_per_rod(moments, rods.ids());
        }
    }
    simulation.unite();
    if (ranks.rank() > 0) return {};
    all.checkpoints.push_back(std::to_string(simulation.rods().size()));
    return all;
}

void check_ranks(const Scene& scene, int steps) {
    parallel::set_thread_count(1);
    const Box box = test::box_at_start(scene);
    const State start = {box, make_start(scene, box)};
    const Measured alone = measured(scene, start, steps, {});
    REQUIRE(alone.series.size() == 5);
    REQUIRE(!alone.contacts.empty());
    REQUIRE(!alone.field.empty());
    REQUIRE(alone.checkpoints.size() == 3);
    for (const int count : {1, 2, 3, 5}) {
        CAPTURE(count);
        const Measured shared =
            test::result_of_first_rank(count, [&](const Ranks& ranks) { return measured(scene, start, steps, ranks); });
        CHECK(same_bits(shared.series, alone.series));
        CHECK(same_bits(shared.contacts, alone.contacts));
        CHECK(same_bits(shared.field, alone.field));
        CHECK(shared.checkpoints == alone.checkpoints);
        REQUIRE(shared.stress_of_rods.size() == alone.stress_of_rods.size());
        for (std::size_t k = 0; k < alone.stress_of_rods.size(); ++k)
            CHECK(shared.stress_of_rods[k].m == alone.stress_of_rods[k].m);
    }
}

Scene crowd(std::uint64_t count) {
    Scene scene;
    scene.seed = 4;
    scene.box.volume_fraction = 0.3;
    scene.rods.count = count;
    scene.rods.length = 2.0;
    scene.rods.start = StartKind::aligned;
    scene.time.step = 0.01;
    scene.time.production = 1.0;
    scene.output.series_every = 4;
    scene.output.field_every = 6;
    scene.output.checkpoint_every = 10;
    scene.output.stress_per_rod = true;
    scene.output.contacts = true;
    scene.output.stress_conventions = true;
    return scene;
}

}  // namespace

TEST_CASE("Brownian rods") {
    check_ranks(crowd(150), 20);
}

TEST_CASE("swimmers, whose paths are remembered by ids") {
    Scene scene = crowd(150);
    scene.motion.self_propulsion = 2.0;
    scene.motion.tumble_rate = 3.0;
    scene.motion.tumble_time = 0.05;
    scene.output.active_stress_lag = 0.04;
    check_ranks(scene, 20);
}

TEST_CASE("fewer rods than ranks") {
    Scene scene = crowd(3);
    scene.box.volume_fraction = 0.2;
    scene.rods.start = StartKind::lattice;
    scene.motion.self_propulsion = 2.0;
    scene.output.active_stress_lag = 0.04;
    check_ranks(scene, 20);
}
