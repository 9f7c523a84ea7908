#include <doctest/doctest.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "jostle/disk/durable_file.hpp"
#include "jostle/error/input_error.hpp"
#include "support/full_disk.hpp"
#include "support/temporary_folder.hpp"

using namespace jostle;

TEST_CASE("an append-only file keeps what it holds, grows and is cut back") {
    const TemporaryFolder folder;
    const std::string path = folder.file("log");
    {
        AppendFile file(path);
        CHECK(file.size() == 0);
        file.write_all("one ");
        file.write_all("two ");
    }
    AppendFile file(path);
    CHECK(file.size() == 8);
    file.write_all("three");
    CHECK(content_of(path) == "one two three");
    file.truncate_to(4);
    file.write_all("four");
    file.sync();
    CHECK(file.size() == 8);
    CHECK(content_of(path) == "one four");
}

TEST_CASE("a full disk is a DiskError that says what to do") {
    AppendFile full("/dev/full");
    int error_number = 0;
    const std::string message = message_of<DiskError>([&] {
        try {
            full.write_all("x");
        } catch (const DiskError& error) {
            error_number = error.error_number();
            throw;
        }
    });
    CHECK(error_number == ENOSPC);
    CHECK(contains(message, "/dev/full: cannot write: No space left on device"));
    CHECK(contains(message, "run the same command again"));
}

TEST_CASE("a write that goes through in part is undone") {
    const TemporaryFolder folder;
    const std::string path = folder.file("log");
    const int code = with_file_size_limit(1000, [&] {
        AppendFile file(path);
        file.write_all(std::string(900, 'a'));
        try {
            file.write_all(std::string(200, 'b'));
        } catch (const DiskError& error) {
            if (file.size() != 900) return 2;
            file.write_all(std::string(100, 'c'));  // there is room for this one
            return error.error_number() == EFBIG ? 0 : 3;
        }
        return 1;
    });
    CHECK(code == 0);
    CHECK(content_of(path) == std::string(900, 'a') + std::string(100, 'c'));
}

TEST_CASE("a file is replaced whole or not at all") {
    const TemporaryFolder folder;
    const std::string path = folder.file("note");
    replace_file(path, "old");
    replace_file(path, "new");
    CHECK(read_file(path) == "new");
    const int code = with_file_size_limit(1000, [&] {
        try {
            replace_file(path, std::string(2000, 'x'));
        } catch (const DiskError&) {
            return 0;
        }
        return 1;
    });
    CHECK(code == 0);
    CHECK(read_file(path) == "new");
    CHECK_FALSE(file_exists(path + ".tmp"));
}

TEST_CASE("what a link in the place of the temporary file leads to is left alone") {
    const TemporaryFolder folder;
    put_content(folder.file("mine"), "keep");
    std::filesystem::create_symlink(folder.file("mine"), folder.file("note.tmp"));
    replace_file(folder.file("note"), "new");
    CHECK(read_file(folder.file("mine")) == "keep");
    CHECK(read_file(folder.file("note")) == "new");
    CHECK_FALSE(std::filesystem::is_symlink(folder.file("note")));
}

TEST_CASE("a missing file is bad input, a folder that cannot be written to is the disk") {
    const TemporaryFolder folder;
    CHECK(contains(message_of<InputError>([&] { read_file(folder.file("none")); }), "there is no such file"));
    CHECK(contains(message_of<InputError>([&] { read_file(folder.path()); }), "is a folder"));
    CHECK_THROWS_AS(AppendFile(folder.file("none/log")), DiskError);
    CHECK_THROWS_AS(replace_file(folder.file("none/log"), "x"), DiskError);
    CHECK_FALSE(file_exists(folder.file("none/log")));
}

TEST_CASE("a file is read in pieces and whole, whatever its size") {
    const TemporaryFolder folder;
    std::string content;
    for (int k = 0; k < 30000; ++k) content += static_cast<char>(k * 7 % 251);
    put_content(folder.file("bytes"), content);
    CHECK(read_file(folder.file("bytes")) == content);
    CHECK(read_file("/proc/self/stat").size() > 0);  // a file whose size reads 0

    ReadFile file(folder.file("bytes"));
    std::string piece, all;
    for (file.read_up_to(777, piece); !piece.empty(); file.read_up_to(777, piece)) all += piece;
    CHECK(all == content);
}

TEST_CASE("the folder of a path") {
    CHECK(folder_of("a/b/c") == "a/b");
    CHECK(folder_of("c") == ".");
    CHECK(folder_of("/c") == "/");
}
