// Small scenes of every kind on several ranks: every number that steps report, every row of series, contacts and
// lineage and every byte of the checkpoints are those of one process. Ranks are threads here.

#include <doctest/doctest.h>

#include <cstring>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "jostle/error/input_error.hpp"
#include "jostle/measurement/measurement.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/scene_file/rods_of_scene.hpp"
#include "jostle/setup/assemble.hpp"
#include "support/first_rank.hpp"

using namespace jostle;

namespace {

const std::filesystem::path scenes = std::filesystem::path(JOSTLE_TEST_SOURCES) / "golden" / "scenes";

/// What is not ready for several ranks: rods that a fluid couples, other solvers, and what cannot do without these.
const std::set<std::string> refused = {"hydrodynamic", "hydrodynamic_open",         "pressed_without_noise",
                                       "pushers",      "solver_adaptive_bb",        "solver_apgd",
                                       "solver_bbpgd", "solver_minimum_map_newton", "swimming_spheres"};

/// As the first rank has it.
struct Outcome {
    TableRows reports, series, contacts, lineage;
    std::vector<std::string> checkpoints;
};

std::vector<double> numbers_of(const StepReport& report) {
    std::vector<double> numbers = {report.time,
                                   static_cast<double>(report.rods),
                                   report.residual,
                                   static_cast<double>(report.iterations),
                                   static_cast<double>(report.solves),
                                   static_cast<double>(report.contacts),
                                   static_cast<double>(report.active_contacts),
                                   report.max_overlap};
    for (const Mat3* virial : {&report.collision_virial, &report.spring_virial, &report.torque_virial,
                               &report.centre_of_mass_virial, &report.centre_line_virial})
        numbers.insert(numbers.end(), virial->m.begin(), virial->m.end());
    numbers.insert(numbers.end(), report.wall_force.begin(), report.wall_force.end());
    for (const Vec3& vector : {report.fixed_rod_force, report.stretch})
        numbers.insert(numbers.end(), {vector.x, vector.y, vector.z});
    return numbers;
}

void append(const TableRows& rows, TableRows& all) {
    all.insert(all.end(), rows.begin(), rows.end());
}

std::string checkpoint_bytes(const Simulation& simulation, const StepSums& sums) {
    return packed(checkpoint_without_rods(simulation, sums, "scene"), simulation.rods_in_order());
}

Outcome outcome_of(const Scene& scene, const State& start, int steps, const Ranks& ranks) {
    Simulation simulation = assemble(scene, start);
    Measurement measurement(scene, simulation);
    measurement.share(ranks);
    simulation.share(ranks);
    Outcome all;
    for (int k = 0; k < steps; ++k) {
        if (k % 5 == 2) simulation.rebalance();
        const StepReport report = simulation.step();
        REQUIRE(report.status == LcpStatus::converged);
        all.reports.push_back(numbers_of(report));
        const Due due = measurement.add(report, simulation);
        append(lineage_rows(lineage_columns(scene), simulation), all.lineage);
        if (due.row) {
            all.series.push_back(measurement.last_row());
            append(contact_rows(contact_columns(scene), simulation), all.contacts);
        }
        if (due.checkpoint) all.checkpoints.push_back(checkpoint_bytes(simulation, measurement.sums()));
    }
    simulation.unite();
    all.checkpoints.push_back(checkpoint_bytes(simulation, {}));
    return all;
}

/// nan is the same as nan: an active stress that is not known yet.
bool same_bits(const TableRows& a, const TableRows& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t k = 0; k < a.size(); ++k)
        if (a[k].size() != b[k].size() || std::memcmp(a[k].data(), b[k].data(), a[k].size() * sizeof(double)) != 0)
            return false;
    return true;
}

void check_ranks(const Scene& scene, const State& start, int steps, std::initializer_list<int> counts) {
    parallel::set_thread_count(1);
    const Outcome alone = outcome_of(scene, start, steps, {});
    for (const int count : counts) {
        CAPTURE(count);
        const Outcome shared = test::result_of_first_rank(
            count, [&](const Ranks& ranks) { return outcome_of(scene, start, steps, ranks); });
        CHECK(same_bits(shared.reports, alone.reports));
        CHECK(same_bits(shared.series, alone.series));
        CHECK(same_bits(shared.contacts, alone.contacts));
        CHECK(same_bits(shared.lineage, alone.lineage));
        CHECK(shared.checkpoints == alone.checkpoints);
    }
}

Scene scene_of(const std::filesystem::path& file) {
    Scene scene = read_scene(file);
    scene.output.series_every = 6;
    scene.output.checkpoint_every = 8;
    scene.output.stress_conventions = true;
    return scene;
}

}  // namespace

TEST_CASE("small scenes of every kind") {
    std::size_t found = 0;
    for (const auto& entry : std::filesystem::directory_iterator(scenes)) {
        if (entry.path().extension() != ".toml") continue;
        const std::string name = entry.path().stem();
        CAPTURE(name);
        const Scene scene = scene_of(entry.path());
        const State start = beginning_of(scene, entry.path()).state;
        if (refused.contains(name)) {
            CHECK_THROWS_AS(assemble(scene, start).require_ready_for_ranks(), InputError);
            continue;
        }
        check_ranks(scene, start, 24, {2, 3, 5});
        ++found;
    }
    CHECK(found >= 19);
}
