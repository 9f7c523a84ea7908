// Cells that grow, divide and push each other, step by step.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "jostle/error/input_error.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/rods/space_filling_order.hpp"
#include "jostle/scene/validate_scene.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/largest_overlap.hpp"
#include "jostle/setup/start.hpp"

using namespace jostle;

namespace {

const Box open_space{{1000, 1000, 1000}, {false, false, false}};

/// The paper's cells in units of their diameter, without noise.
Scene still_cells() {
    Scene scene;
    scene.rods.count = 1;
    scene.rods.length = 2.5;
    scene.motion.brownian = false;
    scene.fluid.kT = 0.0;
    scene.time.step = 0.01;
    scene.growth.rate = 1.0;
    scene.growth.division_length = 6.0;
    scene.growth.division_every = 1;
    return scene;
}

Rods one_cell() {
    Rods rods;
    rods.push_back(0, {500, 500, 500}, {1, 0, 0}, 2.5, 1.0);
    return rods;
}

}  // namespace

TEST_CASE("an isolated cell doubles on schedule, and its line of daughters spreads without an overlap") {
    Simulation simulation = assemble(still_cells(), {open_space, one_cell()});
    for (int generation = 1; generation <= 4; ++generation) {
        for (int step = 0; step < 350; ++step) {
            CHECK(simulation.rods().size() == 1U << (generation - 1));
            const StepReport report = simulation.step();
            REQUIRE(report.status == LcpStatus::converged);
            CHECK(report.rods == 1U << (generation - 1));
            CHECK(report.max_overlap < 0.01 + 1e-4);  // two cells lengthen by rate dt/2 each between two steps
        }
        CHECK(simulation.rods().size() == 1U << generation);
        CHECK(simulation.lineage().size() == 1U << (generation - 1));
    }
    for (const double length : simulation.rods().length) CHECK(length == doctest::Approx(2.5));
    // On the axis all forces are along the line: nothing turns or leaves it, and the middle stays where it was.
    double middle = 0.0;
    for (const Vec3& centre : simulation.rods().centre) {
        CHECK(std::fabs(centre.y - 500.0) < 1e-9);
        middle += centre.x / 16.0;
    }
    CHECK(middle == doctest::Approx(500.0).epsilon(1e-6));
}

TEST_CASE("a dense colony from one cell: no collision is missed, and the same bits for any number of threads") {
    Scene scene = still_cells();
    scene.motion.brownian = true;
    scene.fluid.kT = 0.01;
    scene.growth.rate_deviation = 0.1;
    scene.growth.division_deviation = 0.1;
    scene.growth.division_every = 7;
    std::vector<Rods> ends;
    for (const int threads : {1, 3}) {
        parallel::set_thread_count(threads);
        Simulation simulation = assemble(scene, {open_space, one_cell()});
        double largest = 0.0;
        while (simulation.rods().size() < 300) {
            const StepReport report = simulation.step();
            REQUIRE(report.status == LcpStatus::converged);
            largest = std::max(largest, report.max_overlap);
        }
        // Growth of two cells in a step, and what compliance and large pushes leave: far below what a missed pair
        // would.
        CHECK(largest < 0.1);
        CHECK(largest_overlap(simulation.rods(), open_space) < 0.1);
        ends.push_back(simulation.rods());
    }
    REQUIRE(ends[0].size() == ends[1].size());
    for (std::size_t i = 0; i < ends[0].size(); ++i) {
        CHECK(ends[0].id[i] == ends[1].id[i]);
        CHECK(ends[0].centre[i] == ends[1].centre[i]);
        CHECK(ends[0].length[i] == ends[1].length[i]);
    }
}

TEST_CASE("a run taken up from its state between two divisions goes on bit for bit") {
    struct Case {
        const char* name;
        double kT, other_diameter;
    };
    for (const Case& test : {Case{"noise", 0.01, 1.0}, Case{"hardly any noise", 1e-4, 1.0}, Case{"none", 0.0, 1.0},
                             Case{"thick and thin cells", 0.0, 3.0}}) {
        CAPTURE(std::string(test.name));
        Scene scene = still_cells();
        scene.motion.brownian = test.kT > 0.0;
        scene.fluid.kT = test.kT;
        scene.growth.rate_deviation = 0.4;
        scene.growth.death_rate = 0.01;
        scene.rods.count = 2;
        Rods rods = one_cell();
        rods.push_back(1, {500.3, 503.5, 500}, {0.6, 0.8, 0}, 2.5, test.other_diameter);
        Simulation whole = assemble(scene, {open_space, std::move(rods)});
        for (int step = 0; step < 1111; ++step) whole.step();
        CHECK(!whole.state().previous_forces.empty());
        Simulation again = assemble(scene, whole.state());
        int differing = 0;
        for (int step = 0; step < 400; ++step) {
            whole.step();
            again.step();
            differing += whole.contacts().size() != again.contacts().size() ? 1 : 0;
        }
        CHECK(differing == 0);
        CHECK(whole.rods().size() > 8);
        const Rods a = in_order_of_ids(whole.rods()), b = in_order_of_ids(again.rods());
        CHECK(a.id == b.id);
        CHECK(a.length == b.length);
        CHECK(a.centre == b.centre);
    }
}

// Eq. (5.1) in a chain, whose inner cells are pressed on by all others, whatever the step.
//
//     ()()()()()()()()  ->  ( )()....()( )
TEST_CASE("cells that press on each other grow by what the force leaves them, at any step") {
    constexpr double stall_force = 20.0;
    std::vector<double> middle;
    for (const double time_step : {0.001, 0.004}) {
        Scene scene = still_cells();
        scene.time.step = time_step;
        scene.rods.count = 12;
        scene.growth.division_length = 60.0;
        scene.growth.stall_force = stall_force;
        scene.growth.stall_memory = 0.01;  // 20 of it: the share has forgotten where it began
        Rods rods;
        for (std::uint64_t id = 0; id < 12; ++id)
            rods.push_back(id, {500.0 + 4.0 * static_cast<double>(id), 500, 500}, {1, 0, 0}, 3.0, 1.0);
        Simulation simulation = assemble(scene, {open_space, std::move(rods)});
        for (int step = 0; step < 200; ++step) REQUIRE(simulation.step().status == LcpStatus::converged);
        std::vector<double> compression(12, 0.0);
        const Contacts& contacts = simulation.contacts();
        for (std::size_t l = 0; l < contacts.size(); ++l)
            for (const std::uint32_t row : {contacts.contact[l].i, contacts.contact[l].j})
                compression[row] += 0.5 * simulation.contact_solution().gamma[l];
        for (std::size_t i = 0; i < 12; ++i) {
            CAPTURE(i);
            const double share = simulation.rods().cycle[i].share;
            CHECK(share == doctest::Approx(std::max(0.0, 1.0 - compression[i] / stall_force)).epsilon(0.02));
            if (simulation.rods().id[i] == 0) CHECK(share > 0.5);
            if (simulation.rods().id[i] == 5) middle.push_back(share);
        }
    }
    CHECK(middle[0] < 0.05);
    CHECK(middle[1] == doctest::Approx(middle[0]).epsilon(0.2));  // cells have grown by four times as much
}

TEST_CASE("growth that cannot be is refused with the numbers") {
    Scene scene = still_cells();
    scene.box.edges = Vec3{100, 100, 100};
    scene.time.production = 1.0;
    CHECK_NOTHROW(validate(scene));
    const auto message = [](const Scene& bad) -> std::string {
        try {
            validate(bad);
            assemble(bad, {open_space, one_cell()});
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    Scene bad = scene;
    bad.growth.division_length = 1.0;
    CHECK(message(bad).find("two daughters need") != std::string::npos);
    bad.growth.division_length = 2.5;
    CHECK(message(bad).find("rods.length = 2.5") != std::string::npos);
    bad = scene;
    bad.growth.rate = -1.0;
    CHECK(message(bad).find("is negative") != std::string::npos);
    bad.growth.rate = 20.0;
    CHECK(message(bad).find("the fastest cells lengthen by 0.2 D") != std::string::npos);
    bad = scene;
    bad.growth.death_rate = -0.1;
    CHECK(message(bad).find("growth.death_rate") != std::string::npos);
    bad = scene;
    bad.mobility.model = MobilityModel::slender_body;
    bad.growth.division_length = 2.6;
    CHECK(message(bad).find("daughters as short as L/D = 0.8") != std::string::npos);
}
