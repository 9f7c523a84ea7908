// Every solver on the same contact problems, cold, to the same verified residual: applications of A (or sweeps) and
// time.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <string_view>
#include <vector>

#include "jostle/parallel/parallel_for.hpp"
#include "settled.hpp"

using namespace jostle;

namespace {

constexpr int steps = 5;

constexpr std::array<std::pair<std::string_view, SolverMethod>, 5> methods = {
    {{"bbpgd", SolverMethod::bbpgd},
     {"adaptive_bb", SolverMethod::adaptive_bb},
     {"apgd", SolverMethod::apgd},
     {"minimum_map_newton", SolverMethod::minimum_map_newton},
     {"projected_sor", SolverMethod::projected_sor}}};

void measure(const Crowd& crowd, std::uint64_t count, double tolerance) {
    double seconds_of_bbpgd = 0.0;
    for (const auto& [name, method] : methods) {
        // The same states for all: steps of each solver start from those that the default solver has left.
        const auto leader = settled(crowd, count, SolverMethod::automatic, 1e-7);
        for (int k = 0; k < 10; ++k) leader->step();
        double seconds = 0.0, iterations = 0.0, residual = 0.0;
        std::uint64_t failures = 0;
        for (int k = 0; k < steps; ++k) {
            const auto solver = continued(crowd, *leader, method, tolerance);
            const StepReport report = solver->step();
            failures += report.status == LcpStatus::converged ? 0 : 1;
            seconds += report.seconds[static_cast<std::size_t>(StepPhase::solve_contacts)];
            iterations += static_cast<double>(report.iterations);
            residual = std::max(residual, report.residual);
            leader->step();
        }
        if (method == SolverMethod::bbpgd) seconds_of_bbpgd = seconds;
        const auto bodies = static_cast<double>(leader->rods().size());
        fmt::print("{},{},{:.0e},{},{:.1f},{:.1f},{:.2f},{:.2e},{}\n", crowd.name, leader->rods().size(), tolerance,
                   name, iterations / steps, 1e9 * seconds / (steps * bodies), seconds_of_bbpgd / seconds, residual,
                   failures);
        std::fflush(stdout);
    }
}

}  // namespace

int main(int count, char** words) try {
    if (count > 1) {
        fmt::print(stderr, "usage: {}   (no options: every state, 2000 bodies, one thread)\n", words[0]);
        return 2;
    }
    parallel::set_thread_count(1);
    fmt::print("state,bodies,tolerance,method,iterations,solve_ns,times_faster_than_bbpgd,residual,failures\n");
    for (const Crowd& crowd : all_crowds())
        for (const double tolerance : {1e-5, 1e-6}) measure(crowd, settled_count, tolerance);
    return 0;
} catch (const std::exception& error) {
    fmt::print(stderr, "benchmark_solvers: {}\n", error.what());
    return 1;
}
