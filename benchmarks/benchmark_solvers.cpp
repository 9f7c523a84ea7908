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

constexpr int steps = 15;
constexpr int steps_apart = 5;      ///< between two problems
constexpr double tolerance = 1e-5;  ///< in D

struct Solver {
    const char* name;
    SolverMethod method;
    double range;  ///< in D
};

constexpr std::array<Solver, 6> solvers = {{{"bbpgd all within 0.5 D", SolverMethod::bbpgd, 0.5},
                                            {"bbpgd", SolverMethod::bbpgd, 0.0},
                                            {"adaptive_bb", SolverMethod::adaptive_bb, 0.0},
                                            {"apgd", SolverMethod::apgd, 0.0},
                                            {"minimum_map_newton", SolverMethod::minimum_map_newton, 0.0},
                                            {"projected_sor", SolverMethod::projected_sor, 0.0}}};

/// What a solver did with the problems of all steps.
struct Record {
    std::vector<double> seconds;
    double iterations = 0.0, contacts = 0.0, residual = 0.0;
    int failures = 0;
};

void measure(const Crowd& crowd, ContactKind kind) {
    std::array<Record, solvers.size()> records;
    // Each step of the leader poses one problem, which all solve in turns.
    const auto leader = settled(crowd);
    for (int k = 0; k < steps; ++k) {
        for (int passed = 0; passed < steps_apart; ++passed) leader->step();
        for (std::size_t n = 0; n < solvers.size(); ++n) {
            const auto& [name, method, range] = solvers[n];
            const StepReport report = continued(crowd, *leader, {method, tolerance, range, kind})->step();
            Record& record = records[n];
            record.seconds.push_back(report.seconds[static_cast<std::size_t>(StepPhase::solve_contacts)]);
            record.iterations += static_cast<double>(report.iterations);
            record.contacts += static_cast<double>(report.contacts);
            record.residual = std::max(record.residual, report.residual);
            record.failures += report.status == LcpStatus::converged ? 0 : 1;
        }
    }
    const auto bodies = static_cast<double>(leader->rods().size());
    const auto median_time = [](Record& record) {
        const auto middle = record.seconds.begin() + steps / 2;
        std::nth_element(record.seconds.begin(), middle, record.seconds.end());
        return *middle;
    };
    const double first = median_time(records.front());
    for (std::size_t n = 0; n < solvers.size(); ++n) {
        Record& record = records[n];
        const double time = median_time(record);
        fmt::print("{},{},{},{:.0f},{:.2f},{:.1f},{:.1f},{:.2f},{:.1e},{}\n", crowd.name,
                   kind == ContactKind::hard ? "hard" : "compliant", solvers[n].name, bodies,
                   record.contacts / (steps * bodies), record.iterations / steps, 1e9 * time / bodies, first / time,
                   record.residual, record.failures);
    }
    std::fflush(stdout);
}

}  // namespace

int main(int count, char** words) try {
    std::vector<Crowd> crowds;
    for (int k = 1; k + 1 < count && std::string_view(words[k]) == "--state"; k += 2)
        crowds.push_back(crowd_named(words[k + 1]));
    if (static_cast<std::size_t>(count) != 1 + 2 * crowds.size()) {
        fmt::print(stderr, "usage: {} [--state NAME]...   (else every state; 2000 bodies, one thread)\n", words[0]);
        return 2;
    }
    if (crowds.empty()) crowds = all_crowds();
    parallel::set_thread_count(1);
    fmt::print(
        "state,contact_kind,solver,bodies,contacts_per_body,iterations,solve_ns,times_faster,residual,failures\n");
    for (const Crowd& crowd : crowds)
        for (const ContactKind kind : {ContactKind::compliant, ContactKind::hard}) measure(crowd, kind);
    return 0;
} catch (const std::exception& error) {
    fmt::print(stderr, "benchmark_solvers: {}\n", error.what());
    return 1;
}
