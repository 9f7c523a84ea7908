#include "jostle/run_files/run_directory.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "jostle/disk/durable_file.hpp"
#include "jostle/error/input_error.hpp"

namespace jostle {
namespace {

constexpr const char* lock_mark = "jostle runs here as process ";

InputError refused(const std::string& path, std::string problem, std::string suggestion) {
    InputError::Parts parts;
    parts.key = "--out";
    parts.value = path;
    parts.problem = std::move(problem);
    parts.suggestion = std::move(suggestion);
    return InputError(std::move(parts));
}

std::string without_last_slash(std::string path) {
    while (path.size() > 1 && path.back() == '/') path.pop_back();
    return path.empty() ? "." : path;
}

bool is_empty_folder(const std::string& path) {
    std::error_code error;
    const bool empty = std::filesystem::is_empty(path, error);
    if (error) throw DiskError(path, "list the folder", error.value());
    return empty;
}

/// Whether a folder stands there. Errors: InputError if it is something else.
bool folder_exists(const std::string& path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::not_found) {
        if (std::filesystem::is_symlink(std::filesystem::symlink_status(path, error)))
            throw refused(path, "is a link to a folder that is not there", "Make that folder, or give another name");
        return false;
    }
    if (error) throw DiskError(path, "look at it", error.value());
    if (!std::filesystem::is_directory(status))
        throw refused(path, "is a file, a run needs a folder", "Give another name");
    return true;
}

void require_run_directory(const std::string& path) {
    if (is_empty_folder(path) || is_run_directory(path)) return;
    throw refused(path, "the folder is not empty, and no run of jostle made it", "Give a new or an empty folder");
}

std::string first_line(int descriptor) {
    char text[64] = {};
    const ssize_t got = ::pread(descriptor, text, sizeof text - 1, 0);
    const std::string line(text, got > 0 ? static_cast<std::size_t>(got) : 0);
    return line.substr(0, line.find('\n'));
}

InputError busy(const std::string& path, int descriptor) {
    const std::string line = first_line(descriptor);
    const std::string process = line.starts_with(lock_mark) ? line.substr(std::string(lock_mark).size()) : "unknown";
    return refused(path, "another jostle (process " + process + ") runs in this folder",
                   "Wait for it, stop it, or give another folder");
}

/// Whether the open file is still the one that `path` names: the folder may have been moved aside meanwhile.
bool still_there(int descriptor, const std::string& path) {
    struct stat open_file {};
    struct stat named {};
    return ::fstat(descriptor, &open_file) == 0 && ::stat(path.c_str(), &named) == 0 &&
           open_file.st_ino == named.st_ino && open_file.st_dev == named.st_dev;
}

/// Takes the lock of a folder that exists; returns its descriptor.
int locked(const std::string& path) {
    const std::string file = path + "/lock";
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0) throw DiskError(file, "open for writing", errno);
    try {
        if (::flock(descriptor, LOCK_EX | LOCK_NB) < 0) {
            if (errno == EWOULDBLOCK) throw busy(path, descriptor);
            throw DiskError(file, "lock", errno);
        }
        if (!still_there(descriptor, file)) throw busy(path, descriptor);
        const std::string line = lock_mark + std::to_string(::getpid()) + "\n";
        if (::ftruncate(descriptor, 0) < 0 || ::pwrite(descriptor, line.data(), line.size(), 0) < 0)
            throw DiskError(file, "write", errno);
    } catch (...) {
        ::close(descriptor);
        throw;
    }
    return descriptor;
}

/// rename(2) that never takes the place of something. Result: 0 or errno.
int rename_to_free_name(const std::string& from, const std::string& to) {
    if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return 0;
    if (errno != EINVAL && errno != ENOSYS) return errno;
    // File systems without the flag: look first. Only another --fresh at the same instant could come between.
    if (file_exists(to)) return EEXIST;
    return ::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

}  // namespace

RunDirectory::RunDirectory(const std::string& path) : path_(without_last_slash(path)) {
    if (!folder_exists(path_)) {
        std::error_code error;
        std::filesystem::create_directories(path_, error);
        if (error) throw DiskError(path_, "make the folder", error.value());
    }
    require_run_directory(path_);
    lock_ = locked(path_);
}

RunDirectory::RunDirectory(RunDirectory&& other) noexcept
    : path_(std::move(other.path_)), lock_(std::exchange(other.lock_, -1)) {}

std::string RunDirectory::path() const {
    if (still_there(lock_, path_ + "/lock")) return path_;
    std::error_code unknown;
    const std::filesystem::path lock = std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(lock_), unknown);
    if (unknown || !still_there(lock_, lock.string()))
        throw DiskError(path_, "go on in this folder", "it, or its file lock, was removed while the run went on");
    return lock.parent_path().string();
}

RunDirectory::~RunDirectory() {
    // The lock file stays: removing it would let two processes lock two files of the same name.
    if (lock_ >= 0) ::close(lock_);
}

void require_place_for_run(const std::string& path) {
    const std::string folder = without_last_slash(path);
    if (!folder_exists(folder)) return;
    require_run_directory(folder);
    const int lock = ::open((folder + "/lock").c_str(), O_RDONLY | O_CLOEXEC);
    if (lock < 0) return;
    const std::optional<InputError> held =
        ::flock(lock, LOCK_SH | LOCK_NB) < 0 && errno == EWOULDBLOCK ? std::optional(busy(folder, lock)) : std::nullopt;
    ::close(lock);
    if (held) throw *held;
}

bool is_run_directory(const std::string& path) {
    for (const char* name : {"run.json", "resolved.toml", "checkpoint", "checkpoint.previous"})
        if (file_exists(path + "/" + name)) return true;
    const std::string lock = path + "/lock";
    if (!file_exists(lock)) return false;
    // A lock may end early, or be empty: the process was killed, or the disk was full, before it had written its
    // number. After a power cut there may be zeros in place of what was written.
    std::string content = read_file(lock);
    while (content.ends_with('\0')) content.pop_back();
    return content.starts_with(lock_mark) || std::string_view(lock_mark).starts_with(content);
}

std::string absolute_folder(const std::string& path) {
    return without_last_slash(std::filesystem::absolute(without_last_slash(path)).lexically_normal().string());
}

std::string move_aside(const std::string& path) {
    const std::string folder = absolute_folder(path);
    if (!folder_exists(folder) || is_empty_folder(folder)) return "";
    require_run_directory(folder);
    const int lock = locked(folder);
    int error_number = EEXIST;
    std::string target;
    for (int k = 1; error_number == EEXIST || error_number == ENOTEMPTY; ++k) {
        target = folder + "." + std::to_string(k);
        error_number = rename_to_free_name(folder, target);
    }
    ::close(lock);
    if (error_number != 0) throw DiskError(folder, "rename to " + target, error_number);
    sync_folder(folder_of(folder));
    return target;
}

}  // namespace jostle
