#include <doctest/doctest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include "jostle/disk/byte_buffer.hpp"
#include "jostle/disk/checksum.hpp"
#include "jostle/disk/durable_file.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/run_files/checkpoint.hpp"
#include "support/full_disk.hpp"
#include "support/temporary_folder.hpp"

using namespace jostle;

namespace {

/// Two rods with numbers that no text format and no single precision would give back.
Checkpoint two_rods(std::uint64_t step = 7) {
    Checkpoint checkpoint;
    checkpoint.scene = "seed = 1\n[rods]\ncount = 2\n";
    checkpoint.state.clock.step = step;
    checkpoint.state.clock.time = 0.1 * static_cast<double>(step);
    checkpoint.state.box = {{1.0 / 3.0, 2.0, 1e30}, {true, false, true}};
    checkpoint.state.rods.push_back(0, {0.1, -0.0, 1e29}, {0, 0, 1}, 5.0, 1.0);
    checkpoint.state.rods.push_back(1, {1.0 / 7.0, 2, 3}, {0.6, 0.8, 0}, 0.0, 1.1);
    checkpoint.state.rods.image[1] = {-1, 2, 2147483647};
    checkpoint.state.rods.speed = {0.5, -2.0};
    checkpoint.state.springs = {{1, 0, 2.5, -0.0, 1.0 / 3.0, 1e-300, {-1, 0, 7}}, {0, 1, 0.0, 0.1, 0.0, 5.0, {}}};
    checkpoint.state.previous_forces = {{0, 1, ContactFeature::end_of_j, true, 1.0 / 3.0},
                                        {1, 1, ContactFeature::nearest, false, 1e-300}};
    checkpoint.sums = {{"one", {1.5, -2.25, 1e-310}}, {"other.with.dots", {}}};
    checkpoint.files = {{"series.csv", {321, 0xfedcba9876543210u}},
                        {"trajectory.journal", {12345, 0xabcdef0123456789u}},
                        {"contacts.csv", {1ull << 40, 77}}};
    return checkpoint;
}

bool same(const Checkpoint& a, const Checkpoint& b) {
    return a.scene == b.scene && a.state.clock.step == b.state.clock.step && a.state.clock.time == b.state.clock.time &&
           a.state.box.edges() == b.state.box.edges() && a.state.box.periodic() == b.state.box.periodic() &&
           a.state.rods.centre == b.state.rods.centre && a.state.rods.axis == b.state.rods.axis &&
           std::signbit(a.state.rods.centre[0].y) == std::signbit(b.state.rods.centre[0].y) &&
           a.state.rods.length == b.state.rods.length && a.state.rods.diameter == b.state.rods.diameter &&
           a.state.rods.id == b.state.rods.id && a.state.rods.image == b.state.rods.image &&
           a.state.rods.speed == b.state.rods.speed && a.state.springs == b.state.springs &&
           a.state.previous_forces == b.state.previous_forces && a.sums == b.sums && a.files == b.files;
}

}  // namespace

TEST_CASE("a checkpoint comes back to the last bit") {
    const TemporaryFolder folder;
    CHECK_FALSE(latest_checkpoint(folder.path()).has_value());
    write_checkpoint(folder.path(), two_rods());
    CHECK(same(read_checkpoint(folder.file("checkpoint")), two_rods()));
    CHECK(same(latest_checkpoint(folder.path()).value(), two_rods()));

    write_checkpoint(folder.path(), two_rods(8));
    CHECK(read_checkpoint(folder.file("checkpoint")).state.clock.step == 8);
    CHECK(read_checkpoint(folder.file("checkpoint.previous")).state.clock.step == 7);
    CHECK_FALSE(file_exists(folder.file("checkpoint.tmp")));
}

TEST_CASE("a flip of any bit of a checkpoint is detected, and the file left as it was") {
    const TemporaryFolder folder;
    write_checkpoint(folder.path(), two_rods());
    const std::string path = folder.file("checkpoint");
    const std::string good = content_of(path);
    int undetected = 0;
    for (std::size_t k = 0; k < good.size(); ++k)
        for (int bit = 0; bit < 8; ++bit) {
            const char flipped = static_cast<char>(good[k] ^ (1 << bit));
            put_byte(path, k, flipped);
            const std::string message = message_of<InputError>([&] { latest_checkpoint(folder.path()); });
            const bool told =
                contains(message, "damaged") || contains(message, "not a checkpoint") || contains(message, "truncated");
            if (!told) ++undetected;
            put_byte(path, k, good[k]);
        }
    CHECK(undetected == 0);
    CHECK(content_of(path) == good);
    CHECK(same(read_checkpoint(path), two_rods()));
}

TEST_CASE("a checkpoint cut at any length is called truncated") {
    const TemporaryFolder folder;
    write_checkpoint(folder.path(), two_rods());
    const std::string path = folder.file("checkpoint");
    const std::string good = content_of(path);
    for (std::size_t size = good.size(); size-- > 0;) {
        std::filesystem::resize_file(path, size);
        CAPTURE(size);
        const std::string message = message_of<InputError>([&] { read_checkpoint(path); });
        CHECK(contains(message, "truncated"));
        CHECK(contains(message, std::to_string(size) + " bytes"));
    }
    put_content(path, good + "x");
    CHECK(contains(message_of<InputError>([&] { read_checkpoint(path); }), "damaged"));
}

TEST_CASE("foreign files, other versions and wrong payloads have words of their own") {
    const TemporaryFolder folder;
    const std::string path = folder.file("checkpoint");
    put_content(path, "[box]\nvolume_fraction = 0.2\n# and more than thirty-two bytes\n");
    CHECK(contains(message_of<InputError>([&] { read_checkpoint(path); }), "is not a checkpoint of jostle"));
    CHECK(contains(message_of<InputError>([&] { read_checkpoint(folder.file("none")); }), "no such file"));

    const auto with_checksum = [](std::string bytes) {
        ByteWriter footer;
        footer.put(checksum(bytes));
        return bytes + footer.bytes();
    };
    write_checkpoint(folder.path(), two_rods());
    const std::string good = content_of(path);
    std::string other = good.substr(0, good.size() - 8);
    other[8] = 1;
    put_content(path, with_checksum(other));
    CHECK(contains(message_of<InputError>([&] { read_checkpoint(path); }), "has format version 1, this jostle reads"));

    // A writer's mistake, with a right checksum: still no crash and no half a checkpoint.
    std::string overfull = good.substr(0, good.size() - 8);
    overfull[24] = '\xff';
    put_content(path, with_checksum(overfull));
    CHECK(contains(message_of<InputError>([&] { read_checkpoint(path); }), "damaged"));
}

TEST_CASE("a damaged checkpoint: the message tells whether the one before is sound") {
    const TemporaryFolder folder;
    write_checkpoint(folder.path(), two_rods(7));
    write_checkpoint(folder.path(), two_rods(8));
    const std::string path = folder.file("checkpoint"), previous = path + ".previous";
    put_byte(path, 100, '~');
    CHECK(contains(message_of<InputError>([&] { latest_checkpoint(folder.path()); }),
                   previous + " (step 7), is sound: remove " + path));
    std::filesystem::rename(path, folder.file("kept"));
    CHECK(latest_checkpoint(folder.path())->state.clock.step == 7);
    std::filesystem::rename(folder.file("kept"), path);
    put_byte(previous, 100, '~');
    CHECK(contains(message_of<InputError>([&] { latest_checkpoint(folder.path()); }), "is no better"));
    std::filesystem::remove(previous);
    CHECK(contains(message_of<InputError>([&] { latest_checkpoint(folder.path()); }), "--fresh"));
}

TEST_CASE("every state that a kill can leave between two checkpoints resumes from a sound one") {
    const TemporaryFolder folder;
    const std::string path = folder.file("checkpoint");
    write_checkpoint(folder.path(), two_rods(1));
    const std::string one = content_of(path);
    write_checkpoint(folder.path(), two_rods(2));
    const std::string two = content_of(path);
    const auto step_left = [&](const std::string& now, const std::string& before, const std::string& unfinished) {
        for (const auto& [name, content] :
             {std::pair{path, now}, {path + ".previous", before}, {path + ".tmp", unfinished}}) {
            std::filesystem::remove(name);
            if (!content.empty()) put_content(name, content);
        }
        const auto found = latest_checkpoint(folder.path());
        const std::uint64_t step = found ? found->state.clock.step : 0;
        write_checkpoint(folder.path(), two_rods(step + 1));  // and the run can go on
        CHECK(latest_checkpoint(folder.path())->state.clock.step == step + 1);
        return step;
    };
    CHECK(step_left("", "", one.substr(0, 50)) == 0);   // within the first write
    CHECK(step_left("", "", one) == 0);                 // before the first rename
    CHECK(step_left(one, "", two.substr(0, 50)) == 1);  // within the second write
    CHECK(step_left(one, "", two) == 1);                // before the renames
    CHECK(step_left("", one, two) == 1);                // between the renames
    CHECK(step_left(two, one, "") == 2);                // after them
}

TEST_CASE("kill -9 at random moments never loses a checkpoint that was written") {
    const TemporaryFolder folder;
    const unsigned seed = 20240607;
    MESSAGE("seed " << seed);
    std::mt19937_64 random(seed);
    std::uint64_t step = 0;
    for (int kill = 0; kill < 12; ++kill) {
        int ends[2];
        REQUIRE(::pipe(ends) == 0);
        const pid_t child = ::fork();
        if (child == 0) {
            for (std::uint64_t next = step + 1;; ++next) {
                write_checkpoint(folder.path(), two_rods(next));
                if (::write(ends[1], &next, sizeof next) != sizeof next) ::_exit(1);
            }
        }
        ::close(ends[1]);
        ::usleep(static_cast<useconds_t>(5000 + random() % 20000));
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
        std::uint64_t told = step, value = 0;
        while (::read(ends[0], &value, sizeof value) == sizeof value) told = value;
        ::close(ends[0]);
        const auto found = latest_checkpoint(folder.path());
        const std::uint64_t now = found ? found->state.clock.step : 0;
        // The last one may be on the disk before it was told; a smaller number would be a lost checkpoint.
        CHECK(now >= told);
        CHECK(now <= told + 1);
        step = now;
    }
    MESSAGE("checkpoints written: " << step);
    CHECK(step > 0);
}

TEST_CASE("what no run has written is refused, though the checksum is right") {
    const double nan = std::nan("");
    const std::vector<std::pair<const char*, std::function<void(Checkpoint&)>>> forgeries = {
        {"time = nan", [&](Checkpoint& c) { c.state.clock.time = nan; }},
        {"time = -1", [&](Checkpoint& c) { c.state.clock.time = -1.0; }},
        {"step = ", [&](Checkpoint& c) { c.state.clock.step = ~std::uint64_t{0}; }},
        {"edge of the box = nan",
         [&](Checkpoint& c) {
             c.state.box = Box({nan, 10, 10});
         }},
        {"edge of the box = 1e+300",
         [&](Checkpoint& c) {
             c.state.box = Box({10, 1e300, 10});
         }},
        {"edge of the box = 0",
         [&](Checkpoint& c) {
             c.state.box = Box({10, 0, 10});
         }},
        {"periodic along z in a flat box = 1",
         [&](Checkpoint& c) {
             c.state.box = Box({10, 10, 0});
         }},
        {"z in a flat box in row 0 = 2",
         [&](Checkpoint& c) {
             c.state.box = Box({10, 10, 0}, {true, true, false});
             c.state.rods.centre[0].z = 2.0;
         }},
        {"centre in row 1 = nan", [&](Checkpoint& c) { c.state.rods.centre[1].y = nan; }},
        {"centre in row 0 = 0.5", [&](Checkpoint& c) { c.state.rods.centre[0].x = 0.5; }},
        {"centre in row 1 = -1", [&](Checkpoint& c) { c.state.rods.centre[1].x = -1.0; }},
        {"centre in row 1 = 1e+300", [&](Checkpoint& c) { c.state.rods.centre[1].y = 1e300; }},
        {"|axis|^2 in row 0 = 0", [&](Checkpoint& c) { c.state.rods.axis[0] = {}; }},
        {"|axis|^2 in row 1 = 4",
         [&](Checkpoint& c) {
             c.state.rods.axis[1] = {0, 2, 0};
         }},
        {"length in row 0 = -5", [&](Checkpoint& c) { c.state.rods.length[0] = -5.0; }},
        {"length in row 1 = inf", [&](Checkpoint& c) { c.state.rods.length[1] = INFINITY; }},
        {"diameter in row 1 = 0", [&](Checkpoint& c) { c.state.rods.diameter[1] = 0.0; }},
        {"speed in row 0 = nan", [&](Checkpoint& c) { c.state.rods.speed[0] = nan; }},
        {"an id of two rods = 1",
         [&](Checkpoint& c) {
             c.state.rods.id = {1, 1};
         }},
        {"id of a rod = 2",
         [&](Checkpoint& c) {
             c.state.rods.id = {0, 2};
         }},
        {"growth in row 1 = nan",
         [&](Checkpoint& c) {
             c.state.rods.cycle = {{1, 2, 0, 0, 1}, {1, nan, 0, 0, 1}};
         }},
        {"rod of a spring = 2", [&](Checkpoint& c) { c.state.springs[1].rod_2 = 2; }},
        {"stiffness of a spring = -1", [&](Checkpoint& c) { c.state.springs[0].stiffness = -1.0; }},
        {"contact force = nan", [&](Checkpoint& c) { c.state.previous_forces[1].gamma = nan; }},
    };
    const TemporaryFolder folder;
    for (const auto& [problem, forge] : forgeries) {
        Checkpoint checkpoint = two_rods();
        CHECK(impossible_content(checkpoint) == "");
        forge(checkpoint);
        CHECK(contains(impossible_content(checkpoint), problem));
        write_checkpoint(folder.path(), checkpoint);
        const std::string message = message_of<InputError>([&] { read_checkpoint(folder.file("checkpoint")); });
        CHECK(contains(message, std::string("the checkpoint holds what no run has written: ") + problem));
    }
    Checkpoint cells = two_rods();
    cells.state.rods.cycle.resize(2);
    cells.state.rods.id = {1ull << 52, 5};
    CHECK(impossible_content(cells) == "");  // where cells divide, ids have gaps
    cells.state.rods.id[0] = 1ull << 53;
    CHECK(contains(impossible_content(cells), "id of a rod"));
}

TEST_CASE("a full disk leaves the last checkpoint in place") {
    const TemporaryFolder folder;
    write_checkpoint(folder.path(), two_rods(1));
    const int code = with_file_size_limit(100, [&] {
        try {
            write_checkpoint(folder.path(), two_rods(2));
        } catch (const DiskError&) {
            return 0;
        }
        return 1;
    });
    CHECK(code == 0);
    CHECK(latest_checkpoint(folder.path())->state.clock.step == 1);
    CHECK_FALSE(file_exists(folder.file("checkpoint.tmp")));
}
