#include "start_watch.hpp"

#include <cstdio>

namespace {

constexpr std::chrono::seconds between_lines{5};
/// Kept of the wall time to end in good order (s).
constexpr double kept = 0.5;

}  // namespace

void StartWatch::see(const jostle::Annealing& now) {
    const Clock::time_point here = Clock::now();
    const std::chrono::duration<double> elapsed = here - options_.began;
    if (options_.wall_time && elapsed.count() + kept >= *options_.wall_time)
        throw StartOutOfTime(
            "--walltime: was over before the start was made, of which nothing is kept. Give more, or more --threads");
    if (options_.quiet || options_.json || here - last_ < between_lines) return;
    last_ = here;
    if (now.steps == 0)
        std::fprintf(stderr, "jostle: annealing the start: Monte Carlo sweep %d, of 400 at most\n", now.sweeps);
    else
        std::fprintf(stderr, "jostle: annealing the start: Brownian step %d, of 600 to 1800\n", now.steps);
}
