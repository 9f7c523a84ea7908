// Starts that several ranks make together have the bits of one process, and all ranks have all rods. Ranks are threads
// here.

#include <doctest/doctest.h>

#include <stdexcept>
#include <utility>

#include "jostle/error/input_error.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/scene/scene_walls.hpp"
#include "jostle/setup/monte_carlo.hpp"
#include "jostle/setup/scattered_rods.hpp"
#include "jostle/setup/start.hpp"
#include "support/first_rank.hpp"
#include "support/sanitizers.hpp"

using namespace jostle;
using jostle::test::under_thread_sanitizer;

namespace {

Scene crowd(std::uint64_t count, double length, double volume_fraction) {
    Scene scene;
    scene.seed = 3;
    scene.rods.count = count;
    scene.rods.length = length;
    scene.box.volume_fraction = volume_fraction;
    scene.time.rms_step = 0.03;
    scene.time.production = 1.0;
    return scene;
}

Box cube_of(const Scene& scene) {
    return {box_edges(scene), box_periodic(scene), scene_walls(scene)};
}

void check_same(const Rods& a, const Rods& b) {
    CHECK(a.id == b.id);
    CHECK(a.centre == b.centre);
    CHECK(a.axis == b.axis);
}

/// What the last of so many ranks of one thread has: what it is told by the others is most.
template <class Work>
auto result_of_last_rank(int count, Work&& work) {
    parallel::set_thread_count(1);
    return test::result_of_rank(count - 1, count, work);
}

}  // namespace

TEST_CASE("annealed rods, spheres, mixtures and monolayers: a start has the same bits on several ranks" *
          doctest::skip(under_thread_sanitizer)) {
    Scene mixture = crowd(50, 3.0, 0.3);
    mixture.rods.length_deviation = 0.5;
    Scene plane = crowd(40, 3.0, 0.0);
    plane.box.volume_fraction.reset();
    plane.box.area_fraction = 0.4;
    plane.box.dimensions = 2;
    struct Case {
        Scene scene;
        int ranks;
    };
    const Case cases[] = {
        {crowd(60, 5.0, 0.25), 2}, {crowd(60, 5.0, 0.25), 5}, {crowd(60, 0.0, 0.45), 3}, {mixture, 3}, {plane, 3}};
    for (const Case& one : cases) {
        const Scene& scene = one.scene;
        const int ranks = one.ranks;
        CAPTURE(scene.rods.length);
        CAPTURE(ranks);
        const Box box = cube_of(scene);
        int steps = 0;
        const Rods alone = make_start(scene, box, std::nullopt, [&](const Annealing& now) { steps = now.steps; });
        REQUIRE(steps >= 600);  // else nothing was annealed
        check_same(alone, result_of_last_rank(
                              ranks, [&](const Ranks& of) { return make_start(scene, box, std::nullopt, {}, of); }));
    }
}

TEST_CASE("dilute rods are drawn anew by the same overlaps on all ranks") {
    const Scene scene = crowd(2000, 5.0, 0.05);
    const Box box = cube_of(scene);
    const Rods alone = scattered_rods(scene, box, std::nullopt);
    for (const int ranks : {2, 5})
        check_same(alone, result_of_last_rank(
                              ranks, [&](const Ranks& of) { return scattered_rods(scene, box, std::nullopt, of); }));
}

TEST_CASE("Monte Carlo makes the same moves, and counts the same overlaps, on any number of ranks") {
    const Scene scene = crowd(600, 1.0, 0.3);
    const Box box = cube_of(scene);
    struct Moved {
        Rods rods;
        std::size_t overlapping = 0;
        std::uint64_t placed = 0, shifted = 0;
    };
    const auto moved = [&](const Ranks& ranks) {
        Moved result{scattered_rods(scene, box, std::nullopt, ranks)};
        MonteCarlo monte_carlo(result.rods, box, scene.seed, ranks);
        for (int k = 1; k <= (under_thread_sanitizer ? 2 : 10); ++k) {
            const MonteCarlo::Moves moves = monte_carlo.sweep(0.3 * k, 4);
            result.placed += moves.placed;
            result.shifted += moves.shifted;
        }
        result.overlapping = monte_carlo.overlapping_rods();
        CHECK(result.overlapping == MonteCarlo(result.rods, box, scene.seed).overlapping_rods());
        return result;
    };
    const Moved alone = moved({});
    CHECK(alone.overlapping > 0);
    for (const int ranks : {2, 7}) {
        const Moved on_ranks = result_of_last_rank(ranks, moved);
        check_same(alone.rods, on_ranks.rods);
        CHECK(alone.overlapping == on_ranks.overlapping);
        CHECK(alone.placed == on_ranks.placed);
        CHECK(alone.shifted == on_ranks.shifted);
    }
}

TEST_CASE("all ranks stop where the watch of one does, and where rods do not fit" *
          doctest::skip(under_thread_sanitizer)) {
    const Scene scene = crowd(60, 5.0, 0.3);
    const Box box = cube_of(scene);
    for (const int steps : {0, 50}) {
        run_as_ranks(3, [&](const Ranks& ranks) {
            const auto stop = [&](const Annealing& now) {
                if (now.steps == steps) throw std::domain_error("enough");
            };
            if (ranks.rank() == 0)
                CHECK_THROWS_AS(make_start(scene, box, std::nullopt, stop, ranks), std::domain_error);
            else
                CHECK_THROWS_AS(make_start(scene, box, std::nullopt, {}, ranks), StoppedElsewhere);
        });
    }
    Scene dense = crowd(12, 3.0, 0.68);
    dense.rods.start = StartKind::aligned;
    run_as_ranks(2, [&](const Ranks& ranks) {
        CHECK_THROWS_AS(make_start(dense, cube_of(dense), std::nullopt, {}, ranks), InputError);
    });
}
