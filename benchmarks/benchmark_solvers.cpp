// Every solver on the same contact problems, cold, to the same verified residual: applications of A (or sweeps) and
// time.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <vector>

#include "jostle/parallel/parallel_for.hpp"
#include "settled.hpp"

using namespace jostle;

namespace {

constexpr int steps = 5;

struct Solver {
    const char* name;
    SolverMethod method;
    double range;  ///< contacts with a smaller gap (in D) are all in the problem; 0: only those that may collide
};

constexpr std::array<Solver, 6> solvers = {{{"bbpgd, all within 0.5 D", SolverMethod::bbpgd, 0.5},
                                            {"bbpgd", SolverMethod::bbpgd, 0.0},
                                            {"adaptive_bb", SolverMethod::adaptive_bb, 0.0},
                                            {"apgd", SolverMethod::apgd, 0.0},
                                            {"minimum_map_newton", SolverMethod::minimum_map_newton, 0.0},
                                            {"projected_sor", SolverMethod::projected_sor, 0.0}}};

void measure(const Crowd& crowd, double tolerance) {
    double seconds_of_first = 0.0;
    for (const Solver& solver : solvers) {
        // The same states for all: steps of each solver start from those that a precise solution has left.
        const auto leader = settled(crowd, settled_count, SolverMethod::automatic, 1e-7);
        double seconds = 0.0, iterations = 0.0, contacts = 0.0, residual = 0.0;
        std::uint64_t failures = 0;
        for (int k = 0; k < steps; ++k) {
            leader->step();
            const StepReport report = continued(crowd, *leader, solver.method, tolerance, solver.range)->step();
            failures += report.status == LcpStatus::converged ? 0 : 1;
            seconds += report.seconds[static_cast<std::size_t>(StepPhase::solve_contacts)];
            iterations += static_cast<double>(report.iterations);
            contacts += static_cast<double>(report.contacts);
            residual = std::max(residual, report.residual);
        }
        if (&solver == &solvers.front()) seconds_of_first = seconds;
        const auto bodies = static_cast<double>(leader->rods().size());
        fmt::print("{},{:.0e},\"{}\",{:.2f},{:.1f},{:.1f},{:.2f},{:.1e},{}\n", crowd.name, tolerance, solver.name,
                   contacts / (steps * bodies), iterations / steps, 1e9 * seconds / (steps * bodies),
                   seconds_of_first / seconds, residual, failures);
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
    fmt::print("state,tolerance,solver,contacts_per_body,iterations,solve_ns,times_faster,residual,failures\n");
    for (const Crowd& crowd : all_crowds())
        for (const double tolerance : {1e-5}) measure(crowd, tolerance);
    return 0;
} catch (const std::exception& error) {
    fmt::print(stderr, "benchmark_solvers: {}\n", error.what());
    return 1;
}
