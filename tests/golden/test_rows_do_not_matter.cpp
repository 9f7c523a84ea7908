// Where rods stand in memory does not matter: rows are shuffled at the start, or before every step, and every number of
// the state, of the steps' reports, of sums and fields, and every byte of checkpoint, contacts, lineage and trajectory
// with the stress of each rod is the same, for any number of threads.

#include <doctest/doctest.h>

#include <filesystem>
#include <numeric>
#include <random>

#include "golden_hash.hpp"
#include "jostle/disk/durable_file.hpp"
#include "jostle/measurement/measurement.hpp"
#include "jostle/measurement/side_tables.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/rods/space_filling_order.hpp"
#include "jostle/run_files/trajectory_journal.hpp"
#include "jostle/scene_file/rods_of_scene.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/stress/stress_per_rod.hpp"
#include "support/temporary_folder.hpp"

using namespace jostle;

namespace {

const std::filesystem::path scenes = std::filesystem::path(JOSTLE_TEST_SOURCES) / "golden" / "scenes";
constexpr int steps = 24;

enum class Rows { as_they_are, shuffled_once, shuffled_at_every_step };

std::vector<std::uint32_t> any_order(std::size_t count, std::mt19937& random) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    std::shuffle(order.begin(), order.end(), random);
    return order;
}

struct Outcome {
    std::uint64_t state, results;
    std::string summary, checkpoint, contacts, lineage, journal;
    bool operator==(const Outcome&) const = default;
};

/// The files beside the series that grow while a run lasts, in a folder of their own.
class GrowingFiles {
public:
    explicit GrowingFiles(const Scene& scene)
        : contact_columns_(contact_columns(scene)), lineage_columns_(lineage_columns(scene)) {}

    void append_contacts(const Simulation& simulation) {
        for (const auto& row : contact_rows(contact_columns_, simulation)) contacts_.append(row);
    }
    void append_lineage(const Simulation& simulation) {
        for (const auto& row : lineage_rows(lineage_columns_, simulation)) lineage_.append(row);
    }
    void append_frame(const Simulation& simulation) {
        std::vector<std::uint64_t> ids = simulation.rods().id;
        std::sort(ids.begin(), ids.end());
        journal_.append(simulation.clock().step, simulation.clock().time, simulation.box(), simulation.rods(),
                        stress_per_rod(simulation.collision_moments(), ids));
    }
    std::string bytes(const char* name) const { return read_file(folder_.file(name)); }

private:
    TemporaryFolder folder_;
    TableColumns<ContactState> contact_columns_;
    TableColumns<LineageState> lineage_columns_;
    SeriesFile contacts_ = SeriesFile::create(folder_.file("contacts.csv"), contact_columns_.about());
    SeriesFile lineage_ = SeriesFile::create(folder_.file("lineage.csv"), lineage_columns_.about());
    TrajectoryJournal journal_ =
        TrajectoryJournal::create(folder_.file(trajectory_journal_name), TrajectoryJournal::Content::rods_and_stress);
};

Outcome outcome_of(const Scene& scene, const Beginning& beginning, Rows rows, int threads) {
    parallel::set_thread_count(threads);
    std::mt19937 random(5);
    Rods rods = beginning.state.rods;
    if (rows != Rows::as_they_are) rods = reordered(rods, any_order(rods.size(), random));
    Simulation simulation = assemble(scene, {beginning.state.box, std::move(rods), {}, beginning.state.springs});
    Measurement measurement(scene, simulation);
    GrowingFiles files(scene);
    Hash results;
    for (int k = 1; k <= steps; ++k) {
        if (rows == Rows::shuffled_at_every_step) simulation.reorder(any_order(simulation.rods().size(), random));
        const StepReport report = simulation.step();
        REQUIRE(report.status == LcpStatus::converged);
        add_results(results, report, simulation);
        files.append_lineage(simulation);
        if (rows == Rows::shuffled_at_every_step) simulation.reorder(any_order(simulation.rods().size(), random));
        const Due due = measurement.add(report, simulation);
        if (due.row) {
            results.add(measurement.last_row());
            files.append_contacts(simulation);
        }
        if (due.field)
            for (const auto& row : measurement.last_field()) results.add(row);
        if (due.frame) files.append_frame(simulation);
    }
    const TemporaryFolder folder;
    write_checkpoint(folder.path(), checkpoint_without_rods(simulation, measurement.sums(), "scene"),
                     simulation.rods_in_order());
    return {state_hash(simulation),
            results.value(),
            measurement.summary(simulation).dump(),
            read_file(folder.file("checkpoint")),
            files.bytes("contacts.csv"),
            files.bytes("lineage.csv"),
            files.bytes(trajectory_journal_name)};
}

}  // namespace

TEST_CASE("shuffled rows change no bit") {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(scenes)) {
        if (entry.path().extension() != ".toml") continue;
        ++count;
        CAPTURE(entry.path());
        Scene scene = read_scene(entry.path());
        const Beginning beginning = beginning_of(scene, entry.path());
        scene.output.stress_conventions = true;
        scene.output.series_every = 3;
        scene.output.field_every = 7;
        scene.output.trajectory_every = 4;
        scene.output.stress_per_rod = true;
        const Outcome expected = outcome_of(scene, beginning, Rows::as_they_are, 1);
        for (const Rows rows : {Rows::shuffled_once, Rows::shuffled_at_every_step})
            for (const int threads : {1, 3}) {
                const Outcome outcome = outcome_of(scene, beginning, rows, threads);
                CAPTURE(static_cast<int>(rows));
                CAPTURE(threads);
                CHECK(outcome.state == expected.state);
                CHECK(outcome.results == expected.results);
                CHECK(outcome.summary == expected.summary);
                CHECK(outcome.checkpoint == expected.checkpoint);
                CHECK(outcome.contacts == expected.contacts);
                CHECK(outcome.lineage == expected.lineage);
                CHECK(outcome.journal == expected.journal);
            }
    }
    CHECK(count >= 27);
}
