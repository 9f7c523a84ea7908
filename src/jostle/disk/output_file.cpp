#include "jostle/disk/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <optional>
#include <random>

#include "jostle/disk/durable_file.hpp"

namespace jostle {

namespace {

constexpr int max_links = 40;  // as many as the system follows
constexpr int max_names = 100;

[[noreturn]] void fail(const std::string& path, const char* operation, int error_number) {
    throw DiskError(path, operation, std::generic_category().message(error_number));
}

/// The file that a path leads to, whether it is there or not.
std::string followed(std::string path) {
    for (int k = 0; k < max_links; ++k) {
        std::error_code none;
        const std::filesystem::path target = std::filesystem::read_symlink(path, none);
        if (none) return path;
        path = target.is_absolute() ? target.string() : folder_of(path) + "/" + target.string();
    }
    fail(path, "follow the symbolic link", ELOOP);
}

/// A new file beside `path`; `name` is what it is called.
int new_file_beside(const std::string& path, std::string& name) {
    std::random_device random;
    for (int k = 0; k < max_names; ++k) {
        name = path + "." + std::to_string(random()) + ".tmp";
        const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor >= 0) return descriptor;
        if (errno != EEXIST && errno != EINTR) break;
    }
    fail(path, "make a file in its folder", errno);
}

void write_all(int descriptor, std::string_view bytes, const std::string& path) {
    if (!write_to(descriptor, bytes)) fail(path, "write", errno);
}

/// Owns a descriptor.
struct Descriptor {
    int number;
    ~Descriptor() { ::close(number); }
};

void replace(const std::string& path, const std::optional<mode_t>& permissions, std::string_view content) {
    std::string temporary;
    const Descriptor file{new_file_beside(path, temporary)};
    try {
        if (permissions && ::fchmod(file.number, *permissions) < 0) fail(path, "keep its permissions", errno);
        write_all(file.number, content, path);
        if (::fsync(file.number) < 0) fail(path, "write to the disk", errno);
        rename_file(temporary, path);
    } catch (...) {
        remove_file_if_present(temporary);
        throw;
    }
    sync_folder(folder_of(path));
}

/// The descriptor by which the shell has opened that file for this program's output, as where /dev/stdout is named.
std::optional<int> standard_output(const struct stat& file) {
    for (const int descriptor : {STDOUT_FILENO, STDERR_FILENO}) {
        struct stat status {};
        if (::fstat(descriptor, &status) == 0 && status.st_dev == file.st_dev && status.st_ino == file.st_ino)
            return descriptor;
    }
    return std::nullopt;
}

}  // namespace

void write_output(const std::string& path, std::string_view content) {
    struct stat status {};
    const bool is_there = ::stat(path.c_str(), &status) == 0;
    if (is_there)
        if (const auto descriptor = standard_output(status)) return write_all(*descriptor, content, path);
    if (is_there && S_ISDIR(status.st_mode)) throw refused_file(path, "is a folder, not a file", "Give another name");
    if (is_there) {
        const Descriptor file{::open(path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC)};  // write-protected files stay
        if (file.number < 0) fail(path, "open for writing", errno);
        if (!S_ISREG(status.st_mode)) return write_all(file.number, content, path);
    }
    replace(followed(path), is_there ? std::optional<mode_t>(status.st_mode & 07777) : std::nullopt, content);
}

}  // namespace jostle
