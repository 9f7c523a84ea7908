// One step of the simulation, by its phases: nanoseconds per rod and step, on one thread.

#include <benchmark/benchmark.h>

#include <string>

#include "settled.hpp"

using namespace jostle;

namespace {

constexpr int measured_steps = 300;

/// The sums of what steps reported.
struct Totals {
    std::array<double, step_phase_count> seconds{};
    double contacts = 0.0, active_contacts = 0.0, iterations = 0.0;

    void add(const StepReport& report) {
        for (std::size_t phase = 0; phase < step_phase_count; ++phase) seconds[phase] += report.seconds[phase];
        contacts += static_cast<double>(report.contacts);
        active_contacts += static_cast<double>(report.active_contacts);
        iterations += static_cast<double>(report.iterations);
    }
};

void step(benchmark::State& state, const Crowd& crowd) {
    Simulation& simulation = settled(crowd);
    Totals totals;
    for (auto unused : state) {
        const StepReport report = simulation.step();
        if (report.status != LcpStatus::converged) {
            state.SkipWithError("a step was not solved");
            return;
        }
        totals.add(report);
    }
    const auto steps = static_cast<double>(state.iterations());
    const auto rods = static_cast<double>(simulation.rods().size());
    double sum = 0.0;
    for (std::size_t phase = 0; phase < step_phase_count; ++phase) {
        const double nanoseconds = 1e9 * totals.seconds[phase] / (steps * rods);
        state.counters[std::string("ns_") + step_phase_names[phase]] = nanoseconds;
        sum += nanoseconds;
    }
    state.counters["ns_step"] = sum;
    state.counters["contacts_per_rod"] = totals.contacts / (steps * rods);
    state.counters["active_per_rod"] = totals.active_contacts / (steps * rods);
    state.counters["iterations"] = totals.iterations / steps;
}

}  // namespace

int main(int count, char** words) {
    benchmark::Initialize(&count, words);
    if (benchmark::ReportUnrecognizedArguments(count, words)) return 2;
    for (const Crowd& crowd : all_crowds())
        benchmark::RegisterBenchmark(("step/" + name_of(crowd)).c_str(), step, crowd)
            ->Iterations(measured_steps)
            ->Unit(benchmark::kMillisecond);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
