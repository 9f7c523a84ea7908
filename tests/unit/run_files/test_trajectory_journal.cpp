#include <doctest/doctest.h>

#include <cmath>

#include "jostle/disk/checksum.hpp"
#include "jostle/disk/durable_file.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/run_files/trajectory_journal.hpp"
#include "support/full_disk.hpp"
#include "support/some_rods.hpp"
#include "support/temporary_folder.hpp"

using namespace jostle;

namespace {

/// Three frames of 2, 0 and 3 rods; returns where each ends.
std::vector<std::uint64_t> write_three_frames(const std::string& path) {
    TrajectoryJournal journal = TrajectoryJournal::create(path);
    std::vector<std::uint64_t> ends = {journal.bytes()};
    for (const auto& [step, count] : {std::pair{10u, 2u}, {20u, 0u}, {30u, 3u}}) {
        journal.append(step, 0.1 * step, Box{{4, 5, 6.5 + step}, {true, false, true}}, some_rods(count, step));
        ends.push_back(journal.bytes());
    }
    journal.sync();
    return ends;
}

/// Reads to the end; the number of frames, or -1 if damage was told.
int frames_of(const std::string& path) {
    try {
        TrajectoryReader reader(path);
        TrajectoryFrame frame;
        int frames = 0;
        while (reader.next(frame)) ++frames;
        return frames;
    } catch (const InputError&) {
        return -1;
    }
}

}  // namespace

TEST_CASE("the offset of a sheared box comes back, in single precision and never beyond half an edge") {
    const TemporaryFolder folder;
    const std::string path = folder.file("trajectory.journal");
    TrajectoryJournal journal = TrajectoryJournal::create(path);
    const std::vector<double> offsets = {1.1, -2.3, 0.0, 2.65, std::nextafter(-2.65, 0.0)};
    for (std::size_t k = 0; k < offsets.size(); ++k)
        journal.append(k + 1, 0.1, Box({5.3, 5, 6}).sheared(offsets[k]), some_rods(1, 1));
    journal.sync();
    TrajectoryReader reader(path);
    TrajectoryFrame frame;
    for (const double offset : offsets) {
        REQUIRE(reader.next(frame));
        CHECK(frame.box.offset() == doctest::Approx(offset).epsilon(1e-6));
        CHECK(frame.box.is_periodic());
    }
}

TEST_CASE("frames come back, with a number of rods that changes") {
    const TemporaryFolder folder;
    const std::string path = folder.file("trajectory.journal");
    const auto ends = write_three_frames(path);
    CHECK(ends.back() == content_of(path).size());
    TrajectoryReader reader(path);
    TrajectoryFrame frame;
    for (const auto& [step, count] : {std::pair{10u, 2u}, {20u, 0u}, {30u, 3u}}) {
        REQUIRE(reader.next(frame));
        const Rods rods = some_rods(count, step);
        CHECK(frame.step == step);
        CHECK(frame.time == 0.1 * step);
        CHECK(frame.box.edges() == Vec3{4, 5, 6.5 + step});
        CHECK(frame.box.periodic() == std::array<bool, 3>{true, false, true});
        REQUIRE(frame.size() == count);
        for (std::size_t i = 0; i < count; ++i) {
            CHECK(frame.id[i] == rods.id[i]);
            CHECK(frame.image[i] == rods.image[i]);
            CHECK(frame.length[i] == static_cast<float>(rods.length[i]));
            CHECK(frame.diameter[i] == static_cast<float>(rods.diameter[i]));
            for (int k = 0; k < 3; ++k) {
                CHECK(frame.centre[i][static_cast<std::size_t>(k)] == static_cast<float>(rods.centre[i][k]));
                CHECK(frame.axis[i][static_cast<std::size_t>(k)] == static_cast<float>(rods.axis[i][k]));
            }
        }
    }
    CHECK_FALSE(reader.next(frame));
    CHECK(reader.offset() == ends.back());
}

TEST_CASE("a flip of any bit is detected") {
    const TemporaryFolder folder;
    const std::string path = folder.file("trajectory.journal");
    write_three_frames(path);
    const std::string good = content_of(path);
    int undetected = 0;
    for (std::size_t k = 0; k < good.size(); ++k)
        for (int bit = 0; bit < 8; ++bit) {
            put_byte(path, k, static_cast<char>(good[k] ^ (1 << bit)));
            if (frames_of(path) != -1) ++undetected;
            put_byte(path, k, good[k]);
        }
    CHECK(undetected == 0);
    CHECK(frames_of(path) == 3);
}

TEST_CASE("cut anywhere, the whole frames before the cut are read, and no half one") {
    const TemporaryFolder folder;
    const std::string path = folder.file("trajectory.journal");
    const auto ends = write_three_frames(path);
    const std::string good = content_of(path);
    for (std::size_t size = good.size(); size-- > ends[0];) {
        std::filesystem::resize_file(path, size);
        const int whole = (size >= ends[1]) + (size >= ends[2]) + (size >= ends[3]);
        CHECK(frames_of(path) == whole);
    }
    put_content(path, good.substr(0, 9));
    CHECK(contains(message_of<InputError>([&] { TrajectoryReader reader(path); }), "truncated: it has 9 bytes"));
    put_content(path, "step,time\n1,0.1\n2,0.2\n");
    CHECK(contains(message_of<InputError>([&] { TrajectoryReader reader(path); }), "is not a trajectory journal"));
}

TEST_CASE("resumed at a checkpoint the journal ends as if it had never been stopped") {
    const TemporaryFolder folder;
    const std::string path = folder.file("trajectory.journal");
    const auto ends = write_three_frames(path);
    const std::string good = content_of(path);
    put_content(path, good + good.substr(ends[0], 100));  // a kill within a fourth frame
    {
        TrajectoryJournal journal = TrajectoryJournal::resume(path, ends[2], checksum(good.substr(0, ends[2])));
        CHECK(journal.bytes() == ends[2]);
        CHECK(content_of(path) == good.substr(0, ends[2]));
        journal.append(30, 0.1 * 30, Box{{4, 5, 36.5}, {true, false, true}}, some_rods(3, 30));
    }
    CHECK(content_of(path) == good);
    TrajectoryJournal::resume(path, ends[0], checksum(good.substr(0, ends[0])));
    CHECK(frames_of(path) == 0);
}

TEST_CASE("a journal that does not fit the checkpoint is refused and left alone") {
    const TemporaryFolder folder;
    const std::string path = folder.file("trajectory.journal");
    const auto ends = write_three_frames(path);
    const std::string good = content_of(path);
    const auto refusal = [&](std::uint64_t bytes) {
        const std::string before = content_of(path);
        const std::uint64_t hash = checksum(good.substr(0, bytes));
        const std::string message = message_of<InputError>([&] { TrajectoryJournal::resume(path, bytes, hash); });
        CHECK(content_of(path) == before);
        CHECK(message == message_of<InputError>([&] { TrajectoryJournal::require_frames(path, bytes, hash); }));
        return message;
    };
    CHECK(contains(refusal(ends[3] + 1), "the checkpoint needs"));
    CHECK(contains(refusal(ends[2] - 1), "the checkpoint needs"));
    put_content(path, good.substr(0, ends[3] - 1));
    CHECK(contains(refusal(ends[3]), "whole frames end at byte " + std::to_string(ends[2])));
    put_content(path, good);
    put_byte(path, ends[0] + 80, '~');
    CHECK(contains(refusal(ends[3]), "damaged: frame 1, at byte " + std::to_string(ends[0])));
    {
        TrajectoryJournal other = TrajectoryJournal::create(path);
        for (const auto& [step, count] : {std::pair{10u, 2u}, {20u, 0u}, {30u, 3u}})
            other.append(step, 0.1 * step, Box{}, some_rods(count, step));
    }
    CHECK(content_of(path).size() == ends[3]);
    CHECK(contains(refusal(ends[3]), "is of another run"));
    std::filesystem::remove(path);
    CHECK(contains(message_of<InputError>([&] { TrajectoryJournal::resume(path, ends[3], 0); }), "no such file"));
    CHECK_FALSE(file_exists(path));
}

TEST_CASE("a frame written twice is no trajectory") {
    const TemporaryFolder folder;
    const std::string path = folder.file("trajectory.journal");
    TrajectoryJournal journal = TrajectoryJournal::create(path);
    journal.append(5, 0.5, Box{}, some_rods(1, 1));
    journal.append(5, 0.5, Box{}, some_rods(1, 1));
    CHECK(frames_of(path) == -1);
}

TEST_CASE("a full disk leaves whole frames") {
    const TemporaryFolder folder;
    const std::string path = folder.file("trajectory.journal");
    const int code = with_file_size_limit(3000, [&] {
        TrajectoryJournal journal = TrajectoryJournal::create(path);
        for (unsigned step = 1; step < 100; ++step) try {
                journal.append(step, 0.1 * step, Box{}, some_rods(5, step));
            } catch (const DiskError&) {
                return static_cast<int>(step) - 1;
            }
        return 98;
    });
    CHECK(code == (3000 - 16) / (72 + 5 * 52 + 8));
    CHECK(frames_of(path) == code);
    CHECK(content_of(path).size() == 16 + static_cast<std::size_t>(code) * (72 + 5 * 52 + 8));
}

namespace {

std::vector<Mat3> some_stress(std::size_t count, double scale) {
    std::vector<Mat3> stress(count);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < 9; ++k) stress[i].m[k] = scale / (1.0 + static_cast<double>(9 * i + k));
    return stress;
}

}  // namespace

TEST_CASE("with stress: every rod's comes back to the bit, resumed or not, and any flip of a bit is detected") {
    const TemporaryFolder folder;
    const std::string path = folder.file("trajectory.journal");
    std::uint64_t middle = 0;
    {
        auto journal = TrajectoryJournal::create(path, TrajectoryJournal::Content::rods_and_stress);
        journal.append(10, 1.0, Box{}, some_rods(2, 10), some_stress(2, 0.1));
        journal.append(20, 2.0, Box{}, some_rods(0, 20), {});
        middle = journal.bytes();
        journal.append(30, 3.0, Box{}, some_rods(3, 30), some_stress(3, -7.0));
        CHECK(contains(message_of<InputError>([&] { journal.append(40, 4.0, Box{}, some_rods(3, 40)); }),
                       "0 rows: does not fit the journal (allowed: 3 rows)"));
    }
    const std::string good = content_of(path);
    CHECK(good.size() == 16 + 3 * (72 + 8) + 5 * (52 + 72));
    {
        TrajectoryJournal journal = TrajectoryJournal::resume(path, middle, checksum(good.substr(0, middle)));
        journal.append(30, 3.0, Box{}, some_rods(3, 30), some_stress(3, -7.0));
    }
    CHECK(content_of(path) == good);
    TrajectoryReader reader(path);
    CHECK(reader.content() == TrajectoryJournal::Content::rods_and_stress);
    TrajectoryFrame frame;
    for (const auto& [count, scale] : {std::pair{2u, 0.1}, {0u, 1.0}, {3u, -7.0}}) {
        REQUIRE(reader.next(frame));
        REQUIRE(frame.stress.size() == count);
        const std::vector<Mat3> stress = some_stress(count, scale);
        for (std::size_t i = 0; i < count; ++i) CHECK(frame.stress[i].m == stress[i].m);
    }
    int undetected = 0;
    for (std::size_t k = 0; k < good.size(); ++k)
        for (int bit = 0; bit < 8; ++bit) {
            put_byte(path, k, static_cast<char>(good[k] ^ (1 << bit)));
            if (frames_of(path) != -1) ++undetected;
            put_byte(path, k, good[k]);
        }
    CHECK(undetected == 0);
}

TEST_CASE("a journal without stress takes none") {
    const TemporaryFolder folder;
    TrajectoryJournal journal = TrajectoryJournal::create(folder.file("trajectory.journal"));
    CHECK_THROWS_AS(journal.append(1, 0.1, Box{}, some_rods(2, 1), some_stress(2, 1.0)), InputError);
}
