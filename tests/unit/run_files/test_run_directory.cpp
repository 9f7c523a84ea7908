#include <doctest/doctest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "jostle/disk/durable_file.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/run_files/run_directory.hpp"
#include "support/temporary_folder.hpp"

using namespace jostle;
namespace fs = std::filesystem;

TEST_CASE("a run makes its folder, with those above it, and finds it again") {
    const TemporaryFolder folder;
    const std::string path = folder.file("a/b/run");
    {
        const RunDirectory run(path + "/");
        CHECK(run.path() == path);
        CHECK(run.file("series.csv") == path + "/series.csv");
        CHECK(is_run_directory(path));
    }
    put_content(path + "/series.csv", "step\n");
    CHECK_NOTHROW(RunDirectory{path});
    CHECK(content_of(path + "/series.csv") == "step\n");
}

TEST_CASE("a second process is refused and told the first one's number; kill -9 frees the folder") {
    const TemporaryFolder folder;
    const std::string path = folder.file("run");
    int ready[2];
    REQUIRE(::pipe(ready) == 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const RunDirectory run(path);
        if (::write(ready[1], "x", 1) == 1) ::pause();
        ::_exit(0);
    }
    char byte;
    REQUIRE(::read(ready[0], &byte, 1) == 1);
    const std::string busy = "another jostle (process " + std::to_string(child) + ") runs in this folder";
    CHECK(contains(message_of<InputError>([&] { RunDirectory run(path); }), busy));
    CHECK(contains(message_of<InputError>([&] { move_aside(path); }), busy));
    CHECK(contains(message_of<InputError>([&] { require_place_for_run(path); }), busy));
    CHECK(fs::exists(path));
    CHECK_FALSE(fs::exists(path + ".1"));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    ::close(ready[0]);
    ::close(ready[1]);
    CHECK_NOTHROW(require_place_for_run(path));
    CHECK_NOTHROW(RunDirectory{path});
}

TEST_CASE("the lock goes with the object, also when it is moved") {
    const TemporaryFolder folder;
    const std::string path = folder.file("run");
    {
        RunDirectory first(path);
        const RunDirectory moved(std::move(first));
        CHECK_THROWS_AS(RunDirectory{path}, InputError);
    }
    CHECK_NOTHROW(RunDirectory{path});
}

TEST_CASE("a folder that is moved is followed, and what takes its name is left alone") {
    const TemporaryFolder folder;
    const std::string path = folder.file("run"), moved = folder.file("moved");
    const RunDirectory run(path);
    CHECK_FALSE(run.was_moved());
    fs::rename(path, moved);
    CHECK(run.was_moved());
    CHECK(run.path() == moved);
    {
        const RunDirectory other(path);
        CHECK(run.file("checkpoint") == moved + "/checkpoint");
        CHECK(other.file("checkpoint") == path + "/checkpoint");
    }
    fs::rename(moved, folder.file("again"));
    CHECK(run.path() == folder.file("again"));
    fs::remove_all(folder.file("again"));
    CHECK(contains(message_of<DiskError>([&] { run.file("checkpoint"); }), "was removed while the run went on"));
}

TEST_CASE("a lock that a power cut has left short or full of zeros marks a run all the same") {
    const TemporaryFolder folder;
    const std::string path = folder.file("run");
    fs::create_directory(path);
    const std::string mark = "jostle runs here as process 12\n";
    for (const std::string& content :
         {std::string(), std::string(31, '\0'), mark.substr(0, 9), mark.substr(0, 9) + std::string(22, '\0'), mark}) {
        put_content(path + "/lock", content);
        CHECK(is_run_directory(path));
    }
    put_content(path + "/lock", std::string("\0jostle", 7));
    CHECK_FALSE(is_run_directory(path));
}

TEST_CASE("folders and files that no run made are refused and left alone") {
    const TemporaryFolder folder;
    fs::create_directory(folder.file("mine"));
    put_content(folder.file("mine/thesis.tex"), "x");
    put_content(folder.file("mine/scene.toml"), "seed = 1\n");
    for (const char* name : {"mine", "mine/"}) {
        CHECK(
            contains(message_of<InputError>([&] { RunDirectory run(folder.file(name)); }), "no run of jostle made it"));
        CHECK(contains(message_of<InputError>([&] { move_aside(folder.file(name)); }), "no run of jostle made it"));
    }
    CHECK_FALSE(fs::exists(folder.file("mine/lock")));
    CHECK(contains(message_of<InputError>([&] { RunDirectory run(folder.file("mine/thesis.tex")); }), "is a file"));
    CHECK(content_of(folder.file("mine/thesis.tex")) == "x");
    put_content(folder.file("mine/lock"), "somebody else's\n");
    CHECK_THROWS_AS(RunDirectory{folder.file("mine")}, InputError);
}

TEST_CASE("a fresh start moves the old run aside and deletes nothing") {
    const TemporaryFolder folder;
    const std::string path = folder.file("run");
    CHECK(move_aside(path) == "");
    for (const char* content : {"first", "second", "third"}) {
        { const RunDirectory run(path); }
        put_content(path + "/series.csv", content);
        if (std::string(content) != "third") CHECK(move_aside(path + "/") != "");
    }
    CHECK(content_of(path + ".1/series.csv") == "first");
    CHECK(content_of(path + ".2/series.csv") == "second");
    CHECK(content_of(path + "/series.csv") == "third");
    fs::create_directory(path + ".3");  // an empty folder of that name is someone's too
    CHECK(move_aside(path) == path + ".4");
    CHECK(content_of(path + ".4/series.csv") == "third");
    CHECK_FALSE(fs::exists(path));
}
