// The parts that a step spends its time in, each alone on one thread; each_takes is the time per item. Beside them the
// speed of the memory, which bounds them all.

#include <benchmark/benchmark.h>

#include <string>

#include "jostle/contact/find_contacts.hpp"
#include "jostle/contact/reflection.hpp"
#include "jostle/contact/segment_distance.hpp"
#include "jostle/contact_problem/block_gauss_seidel.hpp"
#include "jostle/math/random.hpp"
#include "jostle/motion/brownian_motion.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "settled.hpp"

using namespace jostle;

namespace {

constexpr double range = 0.1;   ///< of each rod in the search for contacts, in D
constexpr double travel = 0.4;  ///< of the neighbour list, in D

/// Sets each_takes (seconds), given on how many items one pass over the benchmark's body worked.
void count_items(benchmark::State& state, std::size_t items_each_pass) {
    using benchmark::Counter;
    state.counters["items"] = static_cast<double>(items_each_pass);
    state.counters["each_takes"] =
        Counter(static_cast<double>(items_each_pass), Counter::kIsIterationInvariantRate | Counter::kInvert);
}

/// The neighbours of a settled crowd as it lies now.
struct Neighbours {
    explicit Neighbours(const Simulation& simulation)
        : rods(simulation.rods()),
          box(simulation.box()),
          ranges(rods.size(), range * rods.diameter.front()),
          neighbours(travel * rods.diameter.front()) {
        neighbours.update(rods, box, ranges);
    }

    const Rods& rods;
    const Box& box;
    std::vector<double> ranges;
    NeighbourList neighbours;
};

/// The contact problem of a step, with all contacts that it came to have.
struct PosedProblem {
    PosedProblem(const Crowd& crowd, std::size_t bodies)
        : simulation(settled(crowd, bodies)),
          contacts(contacts_of_step(*simulation)),
          mobility(simulation->mobility().at(simulation->rods(), simulation->box())),
          problem(simulation->rods(), *mobility, contacts, gap_velocities(), time_step(), contact_compliance) {}

    static const Contacts& contacts_of_step(Simulation& simulation) {
        for (int k = 0; k < 10; ++k) simulation.step();  // copies begin to forget each other
        return simulation.contacts();
    }
    std::vector<double> gap_velocities() const {
        std::vector<double> b;
        b.reserve(contacts.size());
        for (const Contact& contact : contacts.contact) b.push_back(contact.gap_after / time_step());
        return b;
    }
    double time_step() const { return simulation->settings().time_step; }
    double rods_per_contact() const {
        return static_cast<double>(problem.contact_matrix().rods().size()) / static_cast<double>(contacts.size());
    }

    std::unique_ptr<Simulation> simulation;
    const Contacts& contacts;
    std::unique_ptr<const MobilityOperator> mobility;
    ContactProblem problem;
};

void distance_of_segments(benchmark::State& state) {
    struct Pair {
        Vec3 separation, axis_i, axis_j;
    };
    const auto vector_of = [](std::uint64_t id, std::uint32_t draw) {
        const auto u = uniform4({.id = id}, draw);
        return Vec3{u[0] - 0.5, u[1] - 0.5, u[2] - 0.5};
    };
    std::vector<Pair> pairs;
    for (std::uint64_t id = 0; id < 4096; ++id)
        pairs.push_back({6.0 * vector_of(id, 0), normalised(vector_of(id, 1)), normalised(vector_of(id, 2))});
    for (auto unused : state) {
        double sum = 0.0;
        for (const Pair& pair : pairs)
            sum += squared_norm(nearest_points(pair.separation, pair.axis_i, 2.5, pair.axis_j, 2.5).separation);
        benchmark::DoNotOptimize(sum);
    }
    count_items(state, pairs.size());
}

/// a = b + 3 c (the triad of McCalpin's STREAM), in arrays far larger than any cache. Items are the bytes that it reads
/// and writes; that a is read before it is written over is not counted.
void memory(benchmark::State& state) {
    constexpr std::size_t count = std::size_t{1} << 25;
    std::vector<double> a(count, 0.0), b(count, 1.0), c(count, 2.0);
    for (auto unused : state) {
        for (std::size_t k = 0; k < count; ++k) a[k] = b[k] + 3.0 * c[k];
        benchmark::DoNotOptimize(a.data());
        benchmark::ClobberMemory();
    }
    count_items(state, 3 * count * sizeof(double));
}

/// What an application of A has to read and write at least, a contact: each contact and gamma twice (D and D^T), its
/// local_rods, its diagonal (compliance) and its rate; and its share of the rods' mobilities, forces and velocities.
double bytes_of_application(const PosedProblem& posed) {
    const double contact = 2 * (sizeof(Contact) + sizeof(ContactMatrix::RodPair)) + 4 * sizeof(double);
    const double place = sizeof(MobileRod) + 2 * sizeof(ContactForce) + 2 * sizeof(ContactVelocity);
    return contact + place * posed.rods_per_contact();
}

void application_of_matrix(benchmark::State& state, const Crowd& crowd, std::size_t bodies) {
    const PosedProblem posed(crowd, bodies);
    std::vector<double> gamma(posed.problem.matrix().size(), 1.0), rates(posed.problem.matrix().size());
    for (auto unused : state) {
        posed.problem.matrix().apply(gamma, rates);
        benchmark::DoNotOptimize(rates.data());
    }
    count_items(state, posed.problem.matrix().size());
    state.counters["bytes_each"] = bytes_of_application(posed);
}

/// What a sweep has to read and write at least, a contact: a single contact whole, of which the line with its force is
/// written back, or its part of a pair that touches at several points; and its share of the rods' velocities.
double bytes_of_sweep(const PosedProblem& posed) {
    constexpr double line = 64;
    const auto ends = posed.problem.contact_matrix().rod_pairs();
    const auto same_pair = [](const auto& a, const auto& b) { return a.i == b.i && a.j == b.j; };
    double bytes = 0.0;
    for (std::size_t l = 0; l < ends.size();) {
        std::size_t next = l + 1;
        while (next < ends.size() && same_pair(ends[next], ends[l])) ++next;
        bytes += static_cast<double>(next == l + 1 ? sizeof(ScalarBlock<float>) : sizeof(CoupledBlock)) + line;
        l = next;
    }
    return bytes / static_cast<double>(ends.size()) + 2 * sizeof(SpatialVector<float>) * posed.rods_per_contact();
}

void sweep_over_all(benchmark::State& state, const Crowd& crowd, std::size_t bodies) {
    const PosedProblem posed(crowd, bodies);
    const std::vector<double> start(posed.problem.matrix().size(), 0.0);
    BlockGaussSeidel<float> gauss_seidel(posed.problem, 1e-5, start);
    for (auto unused : state) {
        gauss_seidel.stir_all();
        benchmark::DoNotOptimize(gauss_seidel.sweep(1.1, SweepOver::all));
    }
    count_items(state, posed.problem.matrix().size());
    state.counters["bytes_each"] = bytes_of_sweep(posed);
}

void build_neighbour_list(benchmark::State& state, const Crowd& crowd) {
    const auto simulation = settled(crowd);
    Neighbours found(*simulation);
    for (auto unused : state) {
        found.neighbours.invalidate();
        benchmark::DoNotOptimize(found.neighbours.update(found.rods, found.box, found.ranges));
    }
    state.counters["pairs"] = static_cast<double>(found.neighbours.size());
    count_items(state, found.rods.size());
}

void find_contacts_on_list(benchmark::State& state, const Crowd& crowd) {
    const auto simulation = settled(crowd);
    const Neighbours found(*simulation);
    Contacts contacts;
    for (auto unused : state) {
        contacts.clear();
        benchmark::DoNotOptimize(find_contacts(found.rods, found.box, found.neighbours, found.ranges, contacts));
    }
    state.counters["contacts"] = static_cast<double>(contacts.size());
    count_items(state, found.neighbours.size());
}

void brownian_noise(benchmark::State& state, const Crowd& crowd) {
    const auto simulation_held = settled(crowd);
    const Simulation& simulation = *simulation_held;
    const auto mobility = simulation.mobility().at(simulation.rods(), simulation.box());
    const BrownianMotion motion(1.0);
    Velocities known(simulation.rods().size());
    StepContext context{1, 0, simulation.settings().time_step};
    for (auto unused : state) {
        ++context.step;
        motion.add_velocities(known, simulation.rods(), *mobility, context);
        benchmark::DoNotOptimize(known.linear.data());
    }
    count_items(state, known.size());
}

}  // namespace

int main(int count, char** words) {
    parallel::set_thread_count(1);
    benchmark::Initialize(&count, words);
    if (benchmark::ReportUnrecognizedArguments(count, words)) return 2;
    benchmark::RegisterBenchmark("memory (bytes)", memory);
    benchmark::RegisterBenchmark("segment_distance (pairs)", distance_of_segments);
    for (const std::string name : {"rods/0.20", "rods/0.40"}) {
        const Crowd& crowd = crowd_named(name);
        for (const std::size_t bodies : {std::size_t{2000}, std::size_t{200000}, std::size_t{1000000}}) {
            const std::string state = "/" + name + "/" + std::to_string(bodies) + " (contacts)";
            benchmark::RegisterBenchmark(("apply_A" + state).c_str(), application_of_matrix, crowd, bodies);
            benchmark::RegisterBenchmark(("sweep" + state).c_str(), sweep_over_all, crowd, bodies);
        }
        benchmark::RegisterBenchmark(("build_neighbour_list/" + name + " (rods)").c_str(), build_neighbour_list, crowd);
        benchmark::RegisterBenchmark(("find_contacts/" + name + " (pairs)").c_str(), find_contacts_on_list, crowd);
    }
    benchmark::RegisterBenchmark("brownian_noise (rods)", brownian_noise, crowd_named("rods/0.20"));
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
