#include "jostle/disk/durable_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "jostle/error/one_line.hpp"

namespace jostle {
namespace {

std::string words(int error_number) {
    std::string text = std::generic_category().message(error_number);
    if (error_number == ENOSPC || error_number == EDQUOT || error_number == EFBIG)
        text += ". Make room and run the same command again: it goes on from the last checkpoint";
    return text;
}

/// Repeats a system call that a signal interrupted.
template <class Call>
auto uninterrupted(Call call) {
    auto result = call();
    while (result < 0 && errno == EINTR) result = call();
    return result;
}

struct stat status_of(int descriptor, const std::string& path) {
    struct stat status {};
    if (::fstat(descriptor, &status) < 0) throw DiskError(path, "ask for the size", errno);
    return status;
}

/// The size of a file, or 0 for a pipe. Devices are refused: some have no end.
std::uint64_t readable_size(int descriptor, const std::string& path) {
    const struct stat status = status_of(descriptor, path);
    if (S_ISDIR(status.st_mode)) throw refused_file(path, "is a folder, not a file", "Check the name");
    if (!S_ISREG(status.st_mode) && !S_ISFIFO(status.st_mode))
        throw refused_file(path, "is a device, not a file", "Check the name");
    return static_cast<std::uint64_t>(status.st_size);
}

/// Files are opened without waiting, for a pipe that nobody writes to would be waited for without end. From here on
/// reads and writes wait.
void wait_again(int descriptor, const std::string& path) {
    const int flags = ::fcntl(descriptor, F_GETFL);
    if (flags < 0 || ::fcntl(descriptor, F_SETFL, flags & ~O_NONBLOCK) < 0) throw DiskError(path, "open", errno);
}

}  // namespace

DiskError::DiskError(const std::string& path, const std::string& operation, int error_number)
    : std::runtime_error(on_one_line(path, longest_file_name) + ": cannot " + operation + ": " + words(error_number)),
      error_number_(error_number) {}

DiskError::DiskError(const std::string& path, const std::string& operation, const std::string& reason)
    : std::runtime_error(on_one_line(path, longest_file_name) + ": cannot " + operation + ": " + on_one_line(reason)) {}

InputError refused_file(const std::string& path, std::string problem, std::string suggestion, int line) {
    InputError::Parts parts;
    parts.problem = std::move(problem);
    parts.suggestion = std::move(suggestion);
    parts.place = {path, line, 0};
    return InputError(std::move(parts));
}

AppendFile::AppendFile(std::string path) : path_(std::move(path)) {
    constexpr int flags = O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC;
    descriptor_ = uninterrupted([&] { return ::open(path_.c_str(), flags | O_NONBLOCK, 0666); });
    if (descriptor_ < 0) throw DiskError(path_, "open for writing", errno);
    try {
        wait_again(descriptor_, path_);
        size_ = static_cast<std::uint64_t>(status_of(descriptor_, path_).st_size);
    } catch (...) {
        ::close(descriptor_);
        throw;
    }
}

AppendFile::AppendFile(AppendFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}

AppendFile& AppendFile::operator=(AppendFile&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(descriptor_, other.descriptor_);
    std::swap(size_, other.size_);
    return *this;
}

AppendFile::~AppendFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void AppendFile::write_all(std::string_view bytes) {
    if (!write_to(descriptor_, bytes)) {
        const int error_number = errno;
        // Undo the part that went through; if even this fails, resuming cuts the file at the checkpoint.
        [[maybe_unused]] const int ignored = ::ftruncate(descriptor_, static_cast<off_t>(size_));
        throw DiskError(path_, "write", error_number);
    }
    size_ += bytes.size();
}

void AppendFile::truncate_to(std::uint64_t size) {
    if (uninterrupted([&] { return ::ftruncate(descriptor_, static_cast<off_t>(size)); }) < 0)
        throw DiskError(path_, "shorten", errno);
    size_ = size;
}

void AppendFile::sync() {
    if (uninterrupted([&] { return ::fsync(descriptor_); }) < 0) throw DiskError(path_, "write to the disk", errno);
}

ReadFile::ReadFile(std::string path) : path_(std::move(path)) {
    if (path_.find('\0') != std::string::npos)
        throw refused_file(path_, "the name holds a character 0", "Check the name");
    descriptor_ = uninterrupted([&] { return ::open(path_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC); });
    if (descriptor_ < 0 && (errno == ENOENT || errno == ENOTDIR))
        throw refused_file(path_, "there is no such file", "Check the name");
    if (descriptor_ < 0 && errno == ENXIO) throw refused_file(path_, "is a socket, not a file", "Check the name");
    if (descriptor_ < 0) throw DiskError(path_, "open for reading", errno);
    try {
        size_ = readable_size(descriptor_, path_);
        wait_again(descriptor_, path_);
    } catch (...) {
        ::close(descriptor_);
        throw;
    }
}

ReadFile::~ReadFile() {
    ::close(descriptor_);
}

void ReadFile::read_up_to(std::uint64_t count, std::string& bytes) {
    // A length read from a damaged file must not claim memory that the file cannot fill.
    bytes.resize(std::min(count, std::max<std::uint64_t>(size_, 4096)));
    std::size_t filled = 0;
    while (filled < bytes.size()) {
        const ssize_t got =
            uninterrupted([&] { return ::read(descriptor_, bytes.data() + filled, bytes.size() - filled); });
        if (got < 0) throw DiskError(path_, "read", errno);
        if (got == 0) break;
        filled += static_cast<std::size_t>(got);
    }
    bytes.resize(filled);
}

void ReadFile::go_to(std::uint64_t place) {
    if (::lseek(descriptor_, static_cast<off_t>(place), SEEK_SET) < 0) throw DiskError(path_, "read", errno);
}

bool write_to(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = uninterrupted([&] { return ::write(descriptor, bytes.data(), bytes.size()); });
        if (written < 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

std::string read_file(const std::string& path) {
    ReadFile file(path);
    std::string content, block;
    for (file.read_up_to(file.size() + 4096, block); !block.empty(); file.read_up_to(4096, block)) content += block;
    return content;
}

void write_synced_file(const std::string& path, const std::function<void(AppendFile&)>& write) {
    remove_file_if_present(path);  // what a link of that name leads to is no file of the run
    AppendFile file(path);
    write(file);
    file.sync();
}

void replace_file(const std::string& path, std::string_view content) {
    const std::string temporary = path + ".tmp";
    try {
        write_synced_file(temporary, [&](AppendFile& file) { file.write_all(content); });
        rename_file(temporary, path);
    } catch (...) {
        remove_file_if_present(temporary);
        throw;
    }
    sync_folder(folder_of(path));
}

void rename_file(const std::string& from, const std::string& to) {
    if (::rename(from.c_str(), to.c_str()) < 0) throw DiskError(from, "rename to " + to, errno);
}

void sync_folder(const std::string& folder) {
    const char* operation = "write the folder to the disk";
    const int descriptor = uninterrupted([&] { return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
    if (descriptor < 0) throw DiskError(folder, operation, errno);
    const int result = uninterrupted([&] { return ::fsync(descriptor); });
    const int error_number = errno;
    ::close(descriptor);
    // Some file systems know no fsync of a folder (EINVAL): there is nothing more that could be done.
    if (result < 0 && error_number != EINVAL) throw DiskError(folder, operation, error_number);
}

void remove_file_if_present(const std::string& path) noexcept {
    ::unlink(path.c_str());
}

bool file_exists(const std::string& path) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) == 0) return true;
    if (errno == ENOENT || errno == ENOTDIR) return false;
    throw DiskError(path, "look at it", errno);
}

std::string folder_of(const std::string& path) {
    const std::size_t slash = path.find_last_of('/');
    if (slash == std::string::npos) return ".";
    return slash == 0 ? "/" : path.substr(0, slash);
}

}  // namespace jostle
