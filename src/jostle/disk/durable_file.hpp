#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "jostle/error/input_error.hpp"

namespace jostle {

/// The disk did not do what was asked: full, broken, write-protected. Not the user's input; the command exits with 4.
///
/// `what()`: PATH: cannot OPERATION: REASON (errno's words), and for a full disk what to do.
class DiskError : public std::runtime_error {
public:
    DiskError(const std::string& path, const std::string& operation, int error_number);
    DiskError(const std::string& path, const std::string& operation, const std::string& reason);

    /// The value of errno, or 0 if the reason came as words.
    int error_number() const { return error_number_; }

private:
    int error_number_ = 0;
};

/// The error for a file that jostle cannot take; `line` 0 means the file as a whole.
InputError refused_file(const std::string& path, std::string problem, std::string suggestion, int line = 0);

/// A file that only grows at its end, and can be cut back to an earlier length.
///
/// A write that fails is undone: the file then ends where it ended before, as far as the disk still obeys.
class AppendFile {
public:
    /// Opens `path` for appending, made if it is not there; what it holds is kept. Errors: DiskError.
    explicit AppendFile(std::string path);
    AppendFile(AppendFile&& other) noexcept;
    AppendFile& operator=(AppendFile&& other) noexcept;
    ~AppendFile();

    /// Appends all of `bytes`, by one write(2) where the system allows. Errors: DiskError.
    void write_all(std::string_view bytes);
    /// Cuts the file back to `size` bytes. Errors: DiskError.
    void truncate_to(std::uint64_t size);
    /// Returns when the content is on the disk (fsync). Errors: DiskError.
    void sync();

    std::uint64_t size() const { return size_; }
    const std::string& path() const { return path_; }

private:
    std::string path_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

/// A file read from its beginning, or a pipe, which is empty where nobody writes to it.
class ReadFile {
public:
    /// Errors: InputError if there is no such file, or it is a folder or a device; DiskError otherwise.
    explicit ReadFile(std::string path);
    ReadFile(const ReadFile&) = delete;
    ReadFile& operator=(const ReadFile&) = delete;
    ~ReadFile();

    /// The next `count` bytes, fewer only at the end of the file, into `bytes`. Errors: DiskError.
    void read_up_to(std::uint64_t count, std::string& bytes);
    /// What comes next is what the file has from this byte on. Errors: DiskError, as for a pipe.
    void go_to(std::uint64_t place);

    /// Bytes in the file when it was opened.
    std::uint64_t size() const { return size_; }
    const std::string& path() const { return path_; }

private:
    std::string path_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

/// Writes all of `bytes` to an open file. Result: false, with errno, if the system refuses; a part may be written then.
bool write_to(int descriptor, std::string_view bytes);

/// The whole file. Errors: as ReadFile.
std::string read_file(const std::string& path);

/// Puts `content` in the place of the file: whoever looks, also after a power cut, finds the old or the new, whole.
/// Goes through PATH.tmp; on failure that is removed and the old file stays. Errors: DiskError.
void replace_file(const std::string& path, std::string_view content);

/// The steps of replace_file, for sequences of their own and content that `write` appends to a new file (each ends with
/// an fsync where it matters). Errors: DiskError.
void write_synced_file(const std::string& path, const std::function<void(AppendFile&)>& write);
void rename_file(const std::string& from, const std::string& to);
void sync_folder(const std::string& folder);
void remove_file_if_present(const std::string& path) noexcept;

/// Whether something stands at `path`. Errors: DiskError if the system cannot tell.
bool file_exists(const std::string& path);

/// The folder a path names its file in ("." for a bare name).
std::string folder_of(const std::string& path);

}  // namespace jostle
