// What ranks cost, counted: rods of other ranks that a rank knows, contacts that two ranks work out, messages and their
// bytes. Ranks are threads of this process; no time is measured, for they share its processors.

#include <fmt/core.h>

#include <array>
#include <atomic>
#include <cstdio>
#include <initializer_list>
#include <string_view>

#include "jostle/parallel/counted_link.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/parallel/thread_ranks.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"

using namespace jostle;

namespace {

struct Case {
    const char* name;
    std::uint64_t rods;
    double length, volume_fraction;
    StartKind start = StartKind::random;
};

Scene scene_of(const Case& now) {
    Scene scene;
    scene.seed = 11;
    scene.box.volume_fraction = now.volume_fraction;
    scene.rods.count = now.rods;
    scene.rods.length = now.length;
    scene.rods.start = now.start;
    scene.time.rms_step = 0.03;
    scene.time.production = 1.0;
    return scene;
}

void print_row(const Case& now, const Scene& scene, const State& start, int count, std::size_t colours_per_exchange) {
    constexpr int steps_before = 30, steps = 10;
    Traffic traffic;
    std::atomic<std::uint64_t> contacts_of_ranks = 0, owned = 0, near = 0, ghosts = 0;
    std::uint64_t sweeps = 0, contacts = 0;
    run_as_ranks(count, [&](const Ranks& ranks) {
        Simulation simulation = assemble(scene, start);
        CountedLink link(ranks, traffic);
        simulation.share(Ranks(link));
        simulation.exchange_once_in(colours_per_exchange);
        for (int k = 0; k < steps_before; ++k) simulation.step();
        ranks.any(false);  // all are there
        if (ranks.rank() == 0)
            for (auto* number : {&traffic.exchanges, &traffic.messages, &traffic.bytes, &traffic.agreements,
                                 &traffic.deals, &traffic.bytes_dealt})
                *number = 0;
        ranks.any(false);
        for (int k = 0; k < steps; ++k) {
            const StepReport report = simulation.step();
            contacts_of_ranks += simulation.contacts().size();
            if (ranks.rank() > 0) continue;
            sweeps += report.iterations;
            contacts += report.contacts;
        }
        owned += simulation.domain().counts().owned;
        near += simulation.domain().counts().near;
        ghosts += simulation.domain().counts().ghosts;
    });
    const auto ratio = [](double a, double b) { return b > 0.0 ? a / b : 0.0; };
    const auto number = [](std::uint64_t a) { return static_cast<double>(a); };
    const double rank_sweeps = number(sweeps) * count;
    const double rank_steps = number(steps * static_cast<std::uint64_t>(count));
    fmt::print(
        "| {} | {} | {} | {} | {:.2f} | {:.2f} | {:.3f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.0f} | {:.0f} | {:.1f} "
        "|\n",
        now.name, count, now.rods / static_cast<std::uint64_t>(count), colours_per_exchange,
        ratio(number(near), number(owned)), ratio(number(ghosts), number(owned)),
        ratio(number(contacts_of_ranks), number(contacts)), number(sweeps) / steps,
        ratio(number(traffic.exchanges), rank_sweeps), ratio(number(traffic.messages), rank_sweeps),
        ratio(number(traffic.bytes), 1024.0 * rank_sweeps), number(traffic.agreements) / rank_steps,
        number(traffic.deals) / rank_steps, number(traffic.bytes_dealt) / (1024.0 * rank_steps));
    std::fflush(stdout);
}

void print_heads() {
    fmt::print(
        "| state | ranks | rods a rank | colours an exchange | near / own | ghosts / own | contacts worked out | "
        "sweeps a step | exchanges a "
        "sweep | messages | KiB | agreements a step | deals a step | KiB dealt |\n");
    fmt::print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
}

void print_rows(const Case& now, std::initializer_list<int> rank_counts,
                std::initializer_list<std::size_t> colours_per_exchange = {1}) {
    const Scene scene = scene_of(now);
    const Box box(box_edges(scene), box_periodic(scene));
    const State start = {box, make_start(scene, box)};
    for (const int count : rank_counts)
        for (const std::size_t colours : colours_per_exchange) print_row(now, scene, start, count, colours);
}

}  // namespace

/// Without a word: the same rods on more and more ranks. With "weak": as many rods a rank, however many. With
/// "exchanges": on 8 ranks, which exchange velocities more and more seldom.
int main(int count, char** words) {
    parallel::set_thread_count(1);
    print_heads();
    const std::string_view word = count > 1 ? words[1] : "";
    const std::array<Case, 3> common{{{"phi 0.1", 8000, 5.0, 0.1},
                                      {"phi 0.4", 8000, 5.0, 0.4},
                                      {"parallel rods, phi 0.55", 8000, 5.0, 0.55, StartKind::lattice}}};
    if (word == "exchanges") {
        for (const Case& now : common) print_rows(now, {8}, {1, 2, 4, 64});
        return 0;
    }
    if (word != "weak") {
        for (const Case& now : common) print_rows(now, {2, 4, 8});
        print_rows({"spheres, phi 0.45", 8000, 0.0, 0.45}, {2, 4, 8});
        print_rows({"L/D 20, phi 0.1", 4000, 20.0, 0.1}, {2, 4, 8});
        return 0;
    }
    for (Case now : common)
        for (const int ranks : {1, 2, 4, 8}) {
            now.rods = 2000 * static_cast<std::uint64_t>(ranks);
            print_rows(now, {ranks});
        }
}
