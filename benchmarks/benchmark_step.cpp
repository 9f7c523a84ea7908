// One step of the simulation, by its phases: nanoseconds per body and step. One CSV line a measurement.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <functional>
#include <optional>
#include <stdexcept>

#include "jostle/parallel/freed_memory.hpp"
#include "jostle/parallel/launched_ranks.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/scene_file/same_scene.hpp"
#include "jostle/setup/assemble.hpp"
#include "settled.hpp"

using namespace jostle;

namespace {

const char* const usage =
    "usage: benchmark_step [--state NAME]... [--count N]... [--run FOLDER]... [--threads T]...\n"
    "                      [--colours-per-exchange C]... [--steps S]\n"
    "Measures every combination; without --state all states, without --count 2000 and 20000, without --threads 1.\n"
    "--run: goes on from the checkpoint of that run, and writes nothing there; without --state no other is measured.\n"
    "Times are means over the steps; median_step_ns is the median. --steps: 0 (default) as many as take about a "
    "second, at least 16; 16 of ranks.\n"
    "Started by mpirun its processes share the bodies; the first one prints its own times. They exchange velocities\n"
    "once in so many colours; without --colours-per-exchange as often as makes steps fastest, which is then printed.\n";

struct Options {
    std::vector<std::string> states, runs;
    std::vector<std::uint64_t> counts;
    std::vector<int> threads;
    std::vector<std::size_t> colours_per_exchange;
    std::uint64_t steps = 0;
};

template <class Number>
Number number_from(const std::string& word) {
    Number number{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc{} || end != word.data() + word.size() || number < 1)
        throw std::invalid_argument("\"" + word + "\" is no number above 0");
    return number;
}

Options read_options(int count, char** words) {
    Options options;
    for (int k = 1; k < count; k += 2) {
        const std::string name = words[k];
        if (k + 1 == count) throw std::invalid_argument("a value is missing after " + name);
        const std::string value = words[k + 1];
        if (name == "--state")
            options.states.push_back(crowd_named(value).name);
        else if (name == "--run")
            options.runs.push_back(value);
        else if (name == "--count")
            options.counts.push_back(number_from<std::uint64_t>(value));
        else if (name == "--threads")
            options.threads.push_back(number_from<int>(value));
        else if (name == "--colours-per-exchange")
            options.colours_per_exchange.push_back(number_from<std::size_t>(value));
        else if (name == "--steps")
            options.steps = number_from<std::uint64_t>(value);
        else
            throw std::invalid_argument("unknown option " + name);
    }
    if (options.states.empty() && options.runs.empty())
        for (const Crowd& crowd : all_crowds()) options.states.push_back(crowd.name);
    if (options.counts.empty()) options.counts = {2000, 20000};
    if (options.threads.empty()) options.threads = {1};
    if (options.colours_per_exchange.empty()) options.colours_per_exchange = {0};
    return options;
}

/// Memory that the process holds now, in bytes.
double resident_bytes() {
    std::ifstream file("/proc/self/statm");
    double total = 0.0, resident = 0.0;
    file >> total >> resident;
    return 4096.0 * resident;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

StepReport checked_step(Simulation& simulation) {
    StepReport report = simulation.step();
    if (report.status != LcpStatus::converged) throw std::runtime_error("a step was not solved");
    return report;
}

double seconds_of(const StepReport& report) {
    double sum = 0.0;
    for (const double seconds : report.seconds) sum += seconds;
    return sum;
}

/// The simulation of a run, as its last checkpoint has it.
std::unique_ptr<Simulation> of_run(const std::string& folder) {
    std::optional<Checkpoint> checkpoint = latest_checkpoint(folder);
    if (!checkpoint) throw std::invalid_argument(folder + " holds no checkpoint");
    const Scene scene = scene_of(*checkpoint, folder);
    return std::make_unique<Simulation>(assemble(scene, std::move(checkpoint->state)));
}

void measure(const std::string& state, const std::function<std::unique_ptr<Simulation>()>& prepared,
             const Options& options, const Ranks& ranks) {
    const double bytes_before = resident_bytes();
    parallel::set_thread_count(1);
    const auto simulation = prepared();
    const auto rods = static_cast<double>(simulation->rods().size());  // of cells, those there are at first
    if (!ranks.alone()) simulation->share(ranks);
    parallel::set_thread_count(*std::max_element(options.threads.begin(), options.threads.end()));
    parallel::keep_freed_memory();  // as `jostle run` does
    double once = 0.0;
    for (int k = 0; k < 20; ++k) once = seconds_of(checked_step(*simulation));
    const auto ways = options.threads.size() * options.colours_per_exchange.size();
    for (std::size_t way = 0; way < ways; ++way) {
        const int thread_count = options.threads[way / options.colours_per_exchange.size()];
        parallel::set_thread_count(thread_count);
        simulation->exchange_once_in(options.colours_per_exchange[way % options.colours_per_exchange.size()]);
        const std::uint64_t by_default =  // of ranks a fixed number, for all have to make as many
            ranks.alone() ? std::clamp<std::uint64_t>(static_cast<std::uint64_t>(1.0 / once), 16, 2000) : 16;
        const std::uint64_t wanted = options.steps > 0 ? options.steps : by_default;
        std::vector<StepReport> reports;
        const double waited_before = ranks.seconds_waited();
        const std::clock_t processors_before = std::clock();
        for (std::uint64_t k = 0; k < wanted; ++k) reports.push_back(checked_step(*simulation));
        const double used = static_cast<double>(std::clock() - processors_before) / CLOCKS_PER_SEC;
        const double waited = ranks.seconds_waited();
        // Means over steps: building the neighbour list, every tenth step or so, is a part of the cost.
        std::array<double, step_phase_count> phase{};
        double contacts = 0.0, active = 0.0, iterations = 0.0, solves = 0.0;
        std::vector<double> whole;
        for (const StepReport& report : reports) {
            for (std::size_t k = 0; k < step_phase_count; ++k) phase[k] += report.seconds[k];
            contacts += static_cast<double>(report.contacts);
            active += static_cast<double>(report.active_contacts);
            iterations += static_cast<double>(report.iterations);
            solves += static_cast<double>(report.solves);
            whole.push_back(seconds_of(report));
        }
        const auto total = static_cast<double>(wanted);
        double wall = 0.0;
        for (const double seconds : whole) wall += seconds;
        double mean = 0.0;
        for (double& value : phase) mean += (value *= 1e9 / (total * rods));
        if (ranks.rank() > 0) continue;
        fmt::print("{},{},{},{},{},{}", state, rods, ranks.count(), thread_count, simulation->colours_per_exchange(),
                   wanted);
        for (const double value : phase) fmt::print(",{:.1f}", value);
        fmt::print(",{:.1f},{:.1f},{:.4f},{:.4f},{:.1f},{:.2f},", mean, 1e9 * median(whole) / rods,
                   contacts / (total * rods), active / (total * rods), iterations / total, solves / total);
        if (rods >= 1e5) fmt::print("{:.0f}", (resident_bytes() - bytes_before) / rods);  // else the settling shows
        fmt::print(",{:.3f},{:.3f}\n", std::max(0.0, 1.0 - used / (thread_count * wall)),
                   (waited - waited_before) / wall);
        std::fflush(stdout);
    }
}

}  // namespace

int main(int count, char** words) try {
    const Options options = read_options(count, words);
    const std::optional<LaunchedRanks> launched =
        launch_in_environment().is_of_several() ? std::optional<LaunchedRanks>(std::in_place) : std::nullopt;
    const Ranks ranks = launched ? launched->ranks() : Ranks();
    if (ranks.rank() == 0) {
        fmt::print("state,bodies,ranks,threads,colours_per_exchange,steps");
        for (const char* phase : step_phase_names) fmt::print(",{}_ns", phase);
        fmt::print(
            ",step_ns,median_step_ns,contacts_per_body,active_per_body,iterations,solves,bytes_per_body,waiting,"
            "waiting_for_ranks\n");
    }
    for (const std::string& state : options.states)
        for (const std::uint64_t bodies : options.counts)
            measure(
                state, [&] { return settled(crowd_named(state), bodies); }, options, ranks);
    for (const std::string& run : options.runs)
        measure(
            run, [&] { return of_run(run); }, options, ranks);
    return 0;
} catch (const std::exception& error) {
    fmt::print(stderr, "benchmark_step: {}\n{}", error.what(), usage);
    return 2;
}
