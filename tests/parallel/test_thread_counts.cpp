// The same state, bit for bit, for any number of threads; and the loops and sums that this rests on.

#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <new>
#include <numbers>
#include <vector>

#include "jostle/math/random.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/monte_carlo.hpp"
#include "jostle/setup/remove_overlaps.hpp"
#include "jostle/setup/scattered_rods.hpp"
#include "jostle/setup/start.hpp"
#include "support/sanitizers.hpp"

using namespace jostle;
using jostle::test::under_thread_sanitizer;

namespace {

constexpr std::array<int, 3> thread_counts = {1, 2, 4};

/// Below, at and above the limit where loops start threads, and not a multiple of a block.
constexpr std::array<std::size_t, 9> counts = {
    0,    1,      7, std::size_t{256}, parallel::serial_limit - 1, parallel::serial_limit, parallel::serial_limit + 1,
    2000, 100'003};

/// Sets the number of threads, and puts back the former one at the end of the scope.
class ThreadCount {
public:
    explicit ThreadCount(int count) : former_(parallel::thread_count()) { parallel::set_thread_count(count); }
    ~ThreadCount() { parallel::set_thread_count(former_); }
    ThreadCount(const ThreadCount&) = delete;
    ThreadCount& operator=(const ThreadCount&) = delete;

private:
    int former_;
};

/// Calls body(count) for all of them, with every number of threads.
template <class Body>
void for_all_counts(Body&& body) {
    for (const int threads : thread_counts) {
        const ThreadCount thread_count(threads);
        for (const std::size_t count : counts) {
            CAPTURE(threads);
            CAPTURE(count);
            body(count);
        }
    }
}

/// Terms of very different size, so that any other order of summation gives other last bits.
double uneven_term(std::size_t k) {
    const auto u = uniform4({.seed = 5, .id = k}, 0);
    return (u[0] - 0.5) * std::pow(10.0, 12.0 * u[1] - 6.0);
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    static_assert(std::is_trivially_copyable_v<T>);
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// What a run leaves: the rods, and every number that its steps reported.
struct Outcome {
    Rods rods;
    std::vector<Mat3> virial;
    std::vector<double> residual, max_overlap;
    std::vector<std::uint64_t> iterations;
    std::vector<std::size_t> contacts, active_contacts;
    std::vector<double> gamma;  ///< of the last step
};

/// Cubic, or flat.
Box cube_of(const Scene& scene) {
    return {box_edges(scene), box_periodic(scene)};
}

Rods start_of(const Scene& scene, int threads) {
    const ThreadCount thread_count(threads);
    return make_start(scene, cube_of(scene));
}

Outcome outcome_of(const Scene& scene, const Rods& start, int steps, int threads) {
    const ThreadCount thread_count(threads);
    Simulation simulation = assemble(scene, {cube_of(scene), start});
    Outcome outcome;
    for (int k = 0; k < steps; ++k) {
        const StepReport report = simulation.step();
        REQUIRE(report.status == LcpStatus::converged);
        outcome.virial.push_back(report.collision_virial);
        outcome.residual.push_back(report.residual);
        outcome.max_overlap.push_back(report.max_overlap);
        outcome.iterations.push_back(report.iterations);
        outcome.contacts.push_back(report.contacts);
        outcome.active_contacts.push_back(report.active_contacts);
    }
    outcome.rods = simulation.rods();
    outcome.gamma = simulation.contact_solution().gamma;
    return outcome;
}

void check_same(const Rods& a, const Rods& b) {
    CHECK(same_bits(a.centre, b.centre));
    CHECK(same_bits(a.axis, b.axis));
    CHECK(same_bits(a.length, b.length));
    CHECK(same_bits(a.diameter, b.diameter));
    CHECK(a.id == b.id);
    CHECK(a.image == b.image);
}

void check_same(const Outcome& a, const Outcome& b) {
    check_same(a.rods, b.rods);
    CHECK(same_bits(a.virial, b.virial));
    CHECK(same_bits(a.residual, b.residual));
    CHECK(same_bits(a.max_overlap, b.max_overlap));
    CHECK(a.iterations == b.iterations);
    CHECK(a.contacts == b.contacts);
    CHECK(a.active_contacts == b.active_contacts);
    CHECK(same_bits(a.gamma, b.gamma));
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::uint64_t crowd_count = 600;  ///< sanitizers are slow, and threads start above 512
#elif defined(__has_feature)
constexpr std::uint64_t crowd_count = __has_feature(thread_sanitizer) ? 600 : 2000;
#else
constexpr std::uint64_t crowd_count = 2000;
#endif

/// Brownian bodies at random in a cubic periodic box.
Scene crowd(std::uint64_t count, double length, double volume_fraction) {
    Scene scene;
    scene.seed = 11;
    scene.box.volume_fraction = volume_fraction;
    scene.rods.count = count;
    scene.rods.length = length;
    scene.time.rms_step = 0.03;
    scene.time.production = 1.0;
    // Many more contacts than a step needs, so that loops over contacts start threads.
    if (count < 2000) scene.contact.range = 0.5;
    return scene;
}

/// Not annealed, which would take longer than the steps.
Rods pushed_apart(const Scene& scene) {
    Rods rods = scattered_rods(scene, cube_of(scene), std::nullopt);
    const DragMobility mobility(overlap_removal_drag(true));
    REQUIRE(remove_overlaps(rods, cube_of(scene), mobility).apart);
    return rods;
}

void check_steps_with_every_thread_count(const Scene& scene) {
    const Rods start = pushed_apart(scene);
    const Outcome one_thread = outcome_of(scene, start, 30, 1);
    REQUIRE(one_thread.rods.size() > parallel::serial_limit);  // else no thread would have been started
    REQUIRE(one_thread.contacts.back() > parallel::serial_limit);
    REQUIRE(one_thread.active_contacts.back() > 0);
    for (const int threads : {2, 4}) {
        CAPTURE(threads);
        check_same(one_thread, outcome_of(scene, start, 30, threads));
    }
}

}  // namespace

TEST_CASE("rods: the same bits after 30 steps with 1, 2 and 4 threads") {
    check_steps_with_every_thread_count(crowd(crowd_count, 5.0, 0.3));
}

TEST_CASE("spheres: the same bits after 30 steps with 1, 2 and 4 threads") {
    check_steps_with_every_thread_count(crowd(crowd_count, 0.0, 0.4));
}

TEST_CASE("a monolayer: the same bits after 30 steps with 1, 2 and 4 threads") {
    Scene scene = crowd(crowd_count, 2.0, 0.0);
    scene.box.dimensions = 2;
    scene.box.area_fraction = 0.5;
    scene.motion = {true, 2.0, 0.5, 5.0, 0.2, 5.0};
    scene.contact.range = 0.5;
    check_steps_with_every_thread_count(scene);
}

TEST_CASE("swimmers that tumble and turn round: the same bits after 30 steps with 1, 2 and 4 threads") {
    Scene scene = crowd(crowd_count, 2.0, 0.3);
    scene.motion = {true, 2.0, 0.5, 5.0, 0.2, 5.0};
    check_steps_with_every_thread_count(scene);
}

TEST_CASE("a random start has the same bits with 1, 2 and 4 threads" * doctest::skip(under_thread_sanitizer)) {
    const Scene scene = crowd(parallel::serial_limit + 8, 5.0, 0.16);  // which is annealed
    const Rods one_thread = start_of(scene, 1);
    for (const int threads : {2, 4}) check_same(one_thread, start_of(scene, threads));
}

TEST_CASE("Monte Carlo has the same bits with 1, 2 and 4 threads, which move rods at the same time") {
    Scene scene = crowd(crowd_count, 1.0, 0.3);  // boxes of six to nine times the range of a rod
    const auto moved = [&](int threads) {
        const ThreadCount thread_count(threads);
        const Box box = cube_of(scene);
        Rods rods = scattered_rods(scene, box, std::nullopt);
        MonteCarlo monte_carlo(rods, box, scene.seed);
        for (int k = 1; k <= (under_thread_sanitizer ? 1 : 10); ++k) monte_carlo.sweep(0.3 * k, 4);
        return std::pair(rods, monte_carlo.overlapping_rods());
    };
    const auto [one_thread, overlapping] = moved(1);
    CHECK(overlapping > 0);
    for (const int threads : {2, 4}) {
        const auto [rods, as_many] = moved(threads);
        check_same(one_thread, rods);
        CHECK(overlapping == as_many);
    }
}

TEST_CASE("the number of threads is what was set") {
    for (const int threads : thread_counts) {
        const ThreadCount thread_count(threads);
        CHECK(parallel::thread_count() == threads);
    }
}

TEST_CASE("parallel_for visits every index once") {
    for_all_counts([](std::size_t count) {
        std::vector<int> visits(count, 0);
        parallel_for(count, [&](std::size_t k) { ++visits[k]; });
        CHECK(visits == std::vector<int>(count, 1));
    });
}

TEST_CASE("what a call throws on any thread is thrown where the loop was called, and later loops run as before") {
    for_all_counts([](std::size_t count) {
        const std::size_t bad = count - 1;  // of the last thread
        const auto fail_at_bad = [bad](std::size_t k) { return k == bad ? throw std::bad_alloc() : 1.0; };
        if (count > 0) {
            CHECK_THROWS_AS(parallel_for(count, fail_at_bad), std::bad_alloc);
            CHECK_THROWS_AS(parallel_for_parts(count, fail_at_bad), std::bad_alloc);
            CHECK_THROWS_AS(parallel_sum<double>(count, fail_at_bad), std::bad_alloc);
            CHECK_THROWS_AS(parallel_max(count, 0.0, fail_at_bad), std::bad_alloc);
        }
        CHECK(parallel_sum<double>(count, [](std::size_t) { return 1.0; }) == static_cast<double>(count));
    });
}

TEST_CASE("parallel_for_blocks covers all indices with blocks that end at multiples of the block size") {
    for_all_counts([](std::size_t count) {
        constexpr std::size_t block_size = 64;
        std::vector<int> visits(count, 0);
        std::atomic<std::size_t> misplaced = 0;
        parallel_for_blocks(count, block_size, [&](std::size_t block, std::size_t begin, std::size_t end) {
            if (begin != block * block_size || end <= begin || (end != count && end != begin + block_size)) ++misplaced;
            for (std::size_t k = begin; k < end; ++k) ++visits[k];
        });
        CHECK(misplaced == 0);
        CHECK(visits == std::vector<int>(count, 1));
    });
}

TEST_CASE("parallel_sum: the sum of whole numbers is exact, and a default value where there is nothing to sum") {
    for_all_counts([](std::size_t count) {
        const auto sum = parallel_sum<std::uint64_t>(count, [](std::size_t k) { return std::uint64_t{k} + 1; });
        CHECK(sum == std::uint64_t{count} * (count + 1) / 2);
    });
}

TEST_CASE("parallel_sum: the bits of a rounded sum do not depend on the number of threads") {
    for (const std::size_t count : counts) {
        CAPTURE(count);
        const auto sum_with = [count](int threads) {
            const ThreadCount thread_count(threads);
            return parallel_sum<double>(count, uneven_term);
        };
        const double one_thread = sum_with(1);
        for (const int threads : {2, 3, 4, 7}) CHECK(sum_with(threads) == one_thread);
    }
}

TEST_CASE("parallel_sum is exact, and rounded once: the order of the terms does not matter") {
    constexpr std::size_t count = 100'003;
    double one_after_the_other = 0.0;
    for (std::size_t k = 0; k < count; ++k) one_after_the_other += uneven_term(k);
    const auto sum = parallel_sum<double>(count, uneven_term);
    CHECK(parallel_sum<double>(count, [](std::size_t k) { return uneven_term(count - 1 - k); }) == sum);
    CHECK(sum == doctest::Approx(one_after_the_other).epsilon(1e-12));
    CHECK(sum != one_after_the_other);  // else the terms would not tell one order from another
}

TEST_CASE("parallel_max finds the largest value wherever it lies, and never less than the floor") {
    for_all_counts([](std::size_t count) {
        CHECK(parallel_max(count, 3.5, [](std::size_t) { return -1.0; }) == 3.5);
        for (const std::size_t place : {std::size_t{0}, count / 2, count - 1}) {
            if (place >= count) continue;
            CHECK(parallel_max(count, -1.0, [place](std::size_t k) { return k == place ? 2.0 : 1.0; }) == 2.0);
        }
    });
}
