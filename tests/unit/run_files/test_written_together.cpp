// Files that ranks write together have the same bytes whoever writes them, and a disk that fails is told.

#include <doctest/doctest.h>

#include "jostle/disk/checksum.hpp"
#include "jostle/parallel/thread_ranks.hpp"
#include "jostle/run_files/checkpoint.hpp"
#include "jostle/run_files/trajectory_journal.hpp"
#include "jostle/run_files/written_together.hpp"
#include "support/full_disk.hpp"
#include "support/some_rods.hpp"
#include "support/temporary_folder.hpp"

using namespace jostle;

namespace {

using TakenBy = RodsInOrder::TakenBy;
constexpr std::size_t rod_count = 301, slice = 40;

Checkpoint checkpoint_without_rods() {
    Checkpoint checkpoint;
    checkpoint.scene = "seed = 1\n";
    checkpoint.state.springs = {{1, 0, 2.5, 0.5, 1.0 / 3.0, 2.0, {}}};
    checkpoint.sums = {{"one", {1.5, -2.25}}};
    return checkpoint;
}

/// A journal of two frames and a checkpoint; what each rank does.
void write_files(const std::string& folder, const Ranks& ranks, TakenBy taken_by) {
    Rods rods = some_rods(rod_count, 5);
    for (std::uint64_t k = 0; k < rod_count; ++k) rods.id[k] = 100 * k % rod_count;  // each once, in no order
    Domain domain = ranks.alone() ? Domain() : Domain(ranks);
    if (!ranks.alone()) domain.share_out(rods);
    const RodsInOrder in_order(rods, domain, taken_by, slice);
    if (ranks.rank() > 0) {
        for (int frame = 0; frame < 2; ++frame) TrajectoryJournal::send_rods(in_order);
        return send_rods_of_checkpoint(in_order);
    }
    TrajectoryJournal journal = TrajectoryJournal::create(folder + "/trajectory.journal");
    for (const std::uint64_t step : {1u, 2u}) journal.append(step, 0.5, Box{{1, 1, 1}}, in_order);
    if (journal.hash() != checksum(content_of(folder + "/trajectory.journal")))
        throw std::logic_error("the journal's checksum is another");
    Checkpoint checkpoint = checkpoint_without_rods();
    checkpoint.files = {{"trajectory.journal", {journal.bytes(), journal.hash()}}};
    write_checkpoint(folder, checkpoint, in_order);
}

}  // namespace

TEST_CASE("frames and checkpoints have the same bytes, however many ranks write them") {
    const TemporaryFolder alone;
    write_files(alone.path(), {}, TakenBy::first_rank);
    CHECK(read_checkpoint(alone.file("checkpoint")).state.rods.size() == rod_count);
    for (const int count : {1, 2, 5})
        for (const TakenBy taken_by : {TakenBy::first_rank, TakenBy::all_ranks}) {
            CAPTURE(count);
            const TemporaryFolder folder;
            run_as_ranks(count, [&](const Ranks& ranks) { write_files(folder.path(), ranks, taken_by); });
            for (const char* name : {"trajectory.journal", "checkpoint"})
                CHECK(content_of(folder.file(name)) == content_of(alone.file(name)));
            CHECK_FALSE(file_exists(folder.file("checkpoint.tmp")));
        }
}

TEST_CASE("a file that does not hold what ranks have written to it is an error, and so is one that is not there") {
    const TemporaryFolder folder;
    const std::string path = folder.file("file");
    const auto write = [&](const std::string& damaged) {
        return message_of<DiskError>([&] {
            run_as_ranks(3, [&](const Ranks& ranks) {
                Rods rods = some_rods(rod_count, 5);
                Domain domain(ranks);
                domain.share_out(rods);
                const RodsInOrder in_order(rods, domain, TakenBy::all_ranks, slice);
                std::optional<AppendFile> file;
                if (ranks.rank() == 0) file.emplace(path);
                WrittenTogether together(in_order, file ? &*file : nullptr, [](std::string_view) {});
                together.write_column(8 * rod_count, [&](const FieldWriter::Sink& sink) {
                    in_order.column([](const Rods& of, std::uint32_t row) { return of.id[row]; },
                                    [&](std::size_t before, auto ids) { sink(8 * before, bytes_of(ids)); });
                });
                ranks.any(false);  // all have written
                if (ranks.rank() == 2 && !damaged.empty()) put_byte(damaged, 8 * 150, '~');
                ranks.any(false);
                together.finish();
                if (file && file->size() != 8 * rod_count) throw std::logic_error("the file has another size");
            });
        });
    };
    CHECK(write("").empty());
    CHECK(content_of(path).size() == 8 * rod_count);
    std::filesystem::remove(path);
    CHECK(contains(write(path), "it does not hold what the ranks have written"));
    const std::string told = message_of<DiskError>([&] {
        run_as_ranks(2, [&](const Ranks& ranks) {
            Rods rods = some_rods(rod_count, 5);
            Domain domain(ranks);
            domain.share_out(rods);
            WrittenTogether(RodsInOrder(rods, domain, TakenBy::all_ranks, slice), nullptr, {});
        });
    });
    CHECK(contains(told, "cannot open for writing: No such file"));
}

TEST_CASE("on a full disk the frames before are left, whichever rank meets it") {
    const TemporaryFolder one;
    write_files(one.path(), {}, TakenBy::first_rank);
    const std::size_t all = content_of(one.file("trajectory.journal")).size(), frame = (all - 16) / 2;
    for (const std::size_t room : {frame / 10, frame / 2, frame - 9, frame - 1}) {
        CAPTURE(room);
        const TemporaryFolder folder;
        const int exit_code = with_file_size_limit(16 + frame + room, [&] {
            try {
                run_as_ranks(3, [&](const Ranks& ranks) { write_files(folder.path(), ranks, TakenBy::all_ranks); });
            } catch (const DiskError& error) {
                return contains(error.what(), "trajectory.journal: cannot write: File too large") ? 5 : 6;
            }
            return 7;
        });
        CHECK(exit_code == 5);
        TrajectoryReader reader(folder.file("trajectory.journal"));
        TrajectoryFrame read;
        CHECK(reader.next(read));
        CHECK_FALSE(reader.next(read));
    }
}
