// Steps of several ranks have the bits of steps of one: centres, axes, images, and every number that a step reports,
// while rods change their rank, cuts move, and rods are longer than a rank's part is wide. Ranks are threads here.

#include <doctest/doctest.h>

#include <cstdlib>
#include <cstring>
#include <mutex>
#include <vector>

#include "jostle/contact_problem/previous_forces.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/math/random.hpp"
#include "jostle/parallel/counted_link.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/rods/space_filling_order.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"
#include "support/first_rank.hpp"

using namespace jostle;

namespace {

/// What steps leave: the rods in the order of ids, and every number that they reported.
struct Trace {
    Rods rods;
    std::vector<double> numbers;
    std::size_t arrived = 0;           ///< rods that have changed their rank
    std::vector<std::size_t> pushing;  ///< contacts, step by step
    std::vector<std::size_t> owned, near, ghosts;

    void add(const StepReport& report) {
        pushing.push_back(report.active_contacts);
        for (const Mat3& tensor : {report.collision_virial, report.spring_virial, report.torque_virial,
                                   report.centre_of_mass_virial, report.centre_line_virial})
            for (int k = 0; k < 9; ++k) numbers.push_back(tensor(k / 3, k % 3));
        for (const double number : {report.residual, report.max_overlap, static_cast<double>(report.iterations),
                                    static_cast<double>(report.solves), static_cast<double>(report.contacts),
                                    static_cast<double>(report.active_contacts), static_cast<double>(report.rods),
                                    static_cast<double>(report.step), static_cast<double>(report.status)})
            numbers.push_back(number);
        numbers.insert(numbers.end(), report.wall_force.begin(), report.wall_force.end());
        for (const Vec3& vector : {report.fixed_rod_force, report.stretch})
            numbers.insert(numbers.end(), {vector.x, vector.y, vector.z});
    }
};

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    static_assert(std::is_trivially_copyable_v<T>);
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

void check_same(const Trace& a, const Trace& b) {
    CHECK(a.rods.id == b.rods.id);
    CHECK(same_bits(a.rods.centre, b.rods.centre));
    CHECK(same_bits(a.rods.axis, b.rods.axis));
    CHECK(same_bits(a.rods.length, b.rods.length));
    CHECK(same_bits(a.rods.diameter, b.rods.diameter));
    CHECK(a.rods.image == b.rods.image);
    CHECK(same_bits(a.numbers, b.numbers));
}

constexpr int no_ranks = 0;

/// `rebalance_every`: so many steps; 0: where ranks have more work than others.
Trace trace_of(const Scene& scene, const State& start, int steps, int rank_count, int rebalance_every = 0,
               std::size_t colours_per_exchange = 0) {
    const auto run = [&](const Ranks& ranks) {
        Simulation simulation = assemble(scene, start);
        simulation.share(ranks);
        simulation.exchange_once_in(colours_per_exchange);
        Trace own;
        for (int k = 0; k < steps; ++k) {
            if (rebalance_every > 0 && k % rebalance_every == 0) simulation.rebalance();
            const auto arrived = simulation.domain().counts().arrived;
            own.add(simulation.step());
            if (simulation.domain().counts().arrived != arrived) own.arrived += simulation.domain().counts().arrived;
        }
        own.rods = simulation.rods_of_all_ranks();
        const auto& counts = simulation.domain().counts();
        const auto arrived = ranks.sum(static_cast<std::int64_t>(own.arrived));
        own.arrived = static_cast<std::size_t>(arrived);
        own.owned = ranks.gather(counts.owned);
        own.near = ranks.gather(counts.near);
        own.ghosts = ranks.gather(counts.ghosts);
        return own;
    };
    parallel::set_thread_count(1);
    return rank_count == no_ranks ? run({}) : test::result_of_first_rank(rank_count, run);
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool is_slow = true;
#elif defined(__has_feature)
constexpr bool is_slow = __has_feature(thread_sanitizer) || __has_feature(address_sanitizer);
#else
constexpr bool is_slow = false;
#endif

/// Brownian rods at random.
Scene crowd(std::uint64_t count, double length, double volume_fraction) {
    Scene scene;
    scene.seed = 11;
    scene.box.volume_fraction = volume_fraction;
    scene.rods.count = count;
    scene.rods.length = length;
    scene.time.rms_step = 0.05;
    scene.time.production = 1.0;
    scene.output.stress_conventions = true;
    return scene;
}

/// Sanitizers are to see steps on ranks, not random starts, which take most of their time.
State start_of(Scene scene) {
    if (is_slow && scene.rods.count > 100 && scene.rods.start == StartKind::random)
        scene.rods.start = StartKind::aligned;
    parallel::set_thread_count(1);
    const Box box(box_edges(scene), box_periodic(scene));
    return {box, make_start(scene, box)};
}

/// On these numbers of ranks, balanced where need be, and on one with cuts that move every few steps.
void check_ranks(const Scene& scene, const State& start, int steps, std::initializer_list<int> rank_counts) {
    const Trace alone = trace_of(scene, start, steps, no_ranks);
    for (const int count : rank_counts) {
        if (is_slow && count > 3) continue;
        CAPTURE(count);
        for (const int colours_per_exchange : {1, count, 64}) {
            if (is_slow && colours_per_exchange != count) continue;
            CAPTURE(colours_per_exchange);
            check_same(trace_of(scene, start, steps, count, 0, static_cast<std::size_t>(colours_per_exchange)), alone);
        }
        if (count < 3) continue;
        const Trace moved = trace_of(scene, start, steps, count, 3);
        check_same(moved, alone);
        if (start.rods.size() > 100) CHECK(moved.arrived > 0);
    }
}

}  // namespace

TEST_CASE("dense rods") {
    check_ranks(crowd(800, 5.0, 0.36), start_of(crowd(800, 5.0, 0.36)), 12, {1, 2, 3, 4, 5, 8});
}

TEST_CASE("dense rods of several lengths and diameters") {
    Scene scene = crowd(400, 3.0, 0.4);
    scene.rods.length_deviation = 0.5;
    scene.rods.diameter_deviation = 0.1;
    check_ranks(scene, start_of(scene), 12, {2, 3, 8});
}

TEST_CASE("dilute rods") {
    check_ranks(crowd(500, 5.0, 0.1), start_of(crowd(500, 5.0, 0.1)), 20, {2, 5});
}

TEST_CASE("a dense droplet in an empty box: every rank gets its part of the rods") {
    Scene scene = crowd(400, 3.0, 0.3);
    scene.rods.start = StartKind::aligned;  // takes no time, also with sanitizers
    State start = start_of(scene);
    start.box = Box(4.0 * start.box.edges(), start.box.periodic());
    check_ranks(scene, start, 12, {2, 5});
    const Trace moved = trace_of(scene, start, 4, 4, 3);
    for (const std::size_t owned : moved.owned) CHECK(std::abs(static_cast<double>(owned) - 100.0) <= 5.0);
}

TEST_CASE("spheres") {
    check_ranks(crowd(600, 0.0, 0.45), start_of(crowd(600, 0.0, 0.45)), 12, {2, 4, 8});
}

TEST_CASE("parallel rods, which touch at several points") {
    Scene scene = crowd(480, 5.0, 0.5);
    scene.rods.start = StartKind::lattice;
    check_ranks(scene, start_of(scene), 12, {2, 3, 5});
}

TEST_CASE("rods of any length up to 20 diameters, longer than a rank's part is wide") {
    Scene scene = crowd(150, 20.0, 0.12);
    State start = start_of(scene);
    for (std::size_t i = 0; i < start.rods.size(); ++i)  // shorter ones do not overlap either
        if (i % 4 != 0) start.rods.length[i] *= uniform4({.seed = 3, .id = i}, 0)[0];
    start.rods.length[1] = 0.0;
    check_ranks(scene, start, 12, {2, 3, 8});
}

TEST_CASE("few rods in a small box: ranks without rods, and rods that meet their own images") {
    Scene scene = crowd(6, 3.0, 0.0);
    scene.box.volume_fraction.reset();
    scene.box.edges = Vec3{4.2, 4.4, 4.6};
    check_ranks(scene, start_of(scene), 20, {2, 3, 8});
}

TEST_CASE("swimmers of their own speeds that tumble and turn round") {
    Scene scene = crowd(300, 2.0, 0.25);
    scene.motion.self_propulsion = 20.0;
    scene.motion.self_propulsion_deviation = 5.0;
    scene.motion.tumble_rate = 5.0;
    scene.motion.tumble_time = 0.1;
    scene.motion.reversal_rate = 5.0;
    scene.time.rms_step = 0.03;
    check_ranks(scene, start_of(scene), 12, {2, 5});
}

TEST_CASE("rods that a torque aligns and a force pulls") {
    Scene scene = crowd(200, 4.0, 0.15);
    scene.forces.alignment_energy = 2.0;
    scene.forces.on_rods = {1.0, 0.0, 0.0};
    scene.forces.drift = true;
    check_ranks(scene, start_of(scene), 6, {2, 5});
}

TEST_CASE("rods in two dimensions") {
    Scene scene = crowd(300, 3.0, 0.0);
    scene.box.dimensions = 2;
    scene.box.volume_fraction.reset();
    scene.box.area_fraction = 0.3;
    leave_out_z(scene);
    check_ranks(scene, start_of(scene), 8, {2, 5});
}

TEST_CASE("rods in a box that is open along one direction") {
    Scene scene = crowd(200, 3.0, 0.2);
    State start = start_of(scene);
    start.box = Box(start.box.edges(), {true, false, true});
    check_ranks(scene, start, 8, {2, 5});
}

TEST_CASE("rods between walls and fixed rods, which no rank owns") {
    Scene scene = crowd(200, 3.0, 0.2);
    State start = start_of(scene);
    Rods pillars;
    pillars.push_back(0, 0.5 * start.box.edges(), {0, 0, 1}, 4.0, 1.5);  // rods that it meets at first are thrown out
    pillars.push_back(1, {}, {1, 0, 0}, 3.0, 1.0);
    const Walls walls = {.faces = {true, false, false}};
    scene.contact.overlap_limit = 10.0;
    start.box = Box(start.box.edges(), {false, true, true}, walls)
                    .with_fixed_rods(std::make_shared<const Rods>(std::move(pillars)));
    check_ranks(scene, start, 8, {2, 5});
}

TEST_CASE("soft rods") {
    Scene scene = crowd(300, 3.0, 0.2);
    scene.contact.model = ContactModel::wca;
    scene.time.rms_step = 0.004;
    check_ranks(scene, start_of(scene), 12, {2, 5});
}

TEST_CASE("steps that begin from the forces of the last one, which rods take along") {
    Scene scene = crowd(400, 3.0, 0.4);
    scene.solver.warm_start = WarmStarts::always;
    const State start = start_of(scene);
    check_ranks(scene, start, 12, {2, 3, 8});
    scene.motion.brownian = false;
    scene.motion.self_propulsion = 1.0;
    scene.time.rms_step.reset();
    scene.time.step = 0.02;
    check_ranks(scene, start, 12, {2, 5});
}

TEST_CASE("a crowd large enough for momentum") {
    if (is_slow) return;
    Scene scene = crowd(12000, 2.0, 0.56);
    scene.rods.start = StartKind::aligned;
    scene.motion.brownian = false;
    scene.growth.rate = 3.0;
    scene.growth.division_length = 3.5;
    scene.solver.warm_start = WarmStarts::always;
    scene.solver.tolerance = 1e-3;
    scene.time.rms_step.reset();
    scene.time.step = 0.01;
    const State start = start_of(scene);
    constexpr int steps = 8;
    const Trace alone = trace_of(scene, start, steps, no_ranks);
    check_same(trace_of(scene, start, steps, 2, 0, 3), alone);
    CHECK(is_crowd(alone.pushing[steps - 2]));  // what the last step begins with
}

TEST_CASE("springs between rods however far apart, of swimmers that turn round") {
    Scene scene = crowd(200, 3.0, 0.15);
    scene.springs.file = "none";  // they are given
    scene.motion.self_propulsion = 5.0;
    scene.motion.reversal_rate = 5.0;
    scene.time.rms_step = 0.03;
    State start = start_of(scene);
    for (std::uint64_t k = 0; k < 60; ++k)
        start.springs.push_back({.rod_1 = k, .rod_2 = (7 * k + 3) % 200, .s_1 = 1.5, .s_2 = -1.5, .stiffness = 2.0});
    hold_nearest_images(start.springs, start.rods, start.box);
    check_ranks(scene, start, 12, {2, 3, 8});
}

TEST_CASE("rods in a shear flow, also where the copies above get other numbers") {
    Scene scene = crowd(300, 3.0, 0.25);
    scene.flow.shear_rate = 10.0;
    const State start = start_of(scene);
    check_ranks(scene, start, 40, {2, 3, 8});
    scene.flow.shear_rate = 0.0;
    scene.flow.strain_amplitude = 0.7;
    scene.flow.frequency = 10.0;
    check_ranks(scene, start, 40, {5});
}

TEST_CASE("few rods in a small box that flows: rods that meet their own images and others in several") {
    Scene scene = crowd(6, 3.0, 0.0);
    scene.box.volume_fraction.reset();
    scene.box.edges = Vec3{4.2, 4.4, 4.6};
    scene.flow.shear_rate = 10.0;
    check_ranks(scene, start_of(scene), 60, {2, 3});
}

/// Cells that grow, divide, and press on each other.
Scene colony(std::uint64_t count) {
    Scene scene = crowd(count, 2.0, 0.0);
    scene.box.volume_fraction.reset();
    scene.box.edges = Vec3{40.0, 40.0, 40.0};
    scene.box.periodic = {false, false, false};
    scene.motion.brownian = false;
    scene.time.rms_step.reset();
    scene.time.step = 0.02;
    scene.growth.rate = 2.0;
    scene.growth.rate_deviation = 0.2;
    scene.growth.division_every = 5;
    scene.growth.division_length = 3.0;
    return scene;
}

TEST_CASE("a colony from one cell: ranks without rods, and rods that are born") {
    Scene scene = colony(1);
    scene.growth.stall_force = 100.0;
    const State start = start_of(scene);
    const Trace alone = trace_of(scene, start, 320, no_ranks);
    REQUIRE(alone.rods.size() > 20);
    for (const int count : {2, 3, 5}) check_same(trace_of(scene, start, 320, count), alone);
}

TEST_CASE("cells of several diameters that divide and die, in noise") {
    Scene scene = colony(60);
    scene.motion.brownian = true;
    scene.time.step.reset();
    scene.time.rms_step = 0.05;
    scene.growth.death_rate = 5.0;
    scene.growth.rate = 3.0;
    scene.growth.division_every = 3;
    scene.rods.diameter_deviation = 0.05;
    check_ranks(scene, start_of(scene), 40, {2, 5});
}

TEST_CASE("rods that overlap far at the start: forces take them beyond the neighbours that were gathered") {
    Scene scene = crowd(300, 4.0, 0.15);
    scene.time.rms_step = 0.003;  // noise alone would not bring them so far: they have to be gathered within the step
    State start = start_of(scene);
    start.box = Box(0.75 * start.box.edges(), start.box.periodic());
    for (Vec3& centre : start.rods.centre) centre *= 0.75;
    check_ranks(scene, start, 4, {2, 5});
}

TEST_CASE("ranks that exchange velocities more seldom wait less often") {
    const Scene scene = crowd(200, 3.0, 0.4);
    const State start = start_of(scene);
    const auto exchanges = [&](std::size_t colours) {
        Traffic traffic;
        run_as_ranks(2, [&](const Ranks& ranks) {
            CountedLink link(ranks, traffic);
            Simulation simulation = assemble(scene, start);
            simulation.share(Ranks(link));
            simulation.exchange_once_in(colours);
            for (int k = 0; k < 5; ++k) simulation.step();
        });
        return traffic.exchanges.load();
    };
    CHECK(exchanges(2) < exchanges(1));
    CHECK(2 * exchanges(64) < exchanges(1));
}

TEST_CASE("ranks that are told nothing exchange velocities before each colour, and try now and then to do so less") {
    const Scene scene = crowd(200, 3.0, 0.3);
    const State start = start_of(scene);
    const auto chosen = test::result_of_first_rank(2, [&](const Ranks& ranks) {
        Simulation simulation = assemble(scene, start);
        simulation.share(ranks);
        std::vector<std::size_t> colours;
        for (int k = 0; k < 6; ++k) {
            simulation.step();
            colours.push_back(simulation.colours_per_exchange());
        }
        return colours;
    });
    CHECK(chosen == std::vector<std::size_t>{1, 1, 1, 1, 1, 2});
}

TEST_CASE("what is not ready for several ranks is refused") {
    Scene scene = crowd(20, 2.0, 0.1);
    const State start = start_of(scene);
    const auto refused = [&](auto&& change, const char* key) {
        Scene changed = scene;
        change(changed);
        try {
            trace_of(changed, start, 1, 2);
        } catch (const InputError& error) {
            return std::string(error.what()).find(key) != std::string::npos;
        }
        return false;
    };
    CHECK(!refused([](Scene&) {}, ""));
    CHECK(refused([](Scene& s) { s.solver.method = SolverMethod::apgd; }, "solver.method"));
    CHECK(refused(
        [](Scene& s) {
            s.motion.brownian = false;
            s.time.rms_step.reset();
            s.time.step = 0.01;
            s.pressure.external = 1.0;
        },
        "pressure"));
}
