#pragma once

#include <string>

namespace jostle {

/// The folder of one run, held by this process alone for as long as the object lives.
///
/// The lock is flock(2) on DIR/lock: the system frees it when the process ends, however it ends. The lock goes with a
/// folder that is moved, and so does the object: it never names files of whatever has taken the folder's old name.
class RunDirectory {
public:
    /// Makes the folder if it is not there, and takes its lock.
    ///
    /// Errors: InputError if another process runs there (it is named), if `path` is a file, or if it is a folder with
    /// something in it that no run of jostle made; DiskError.
    explicit RunDirectory(const std::string& path);
    RunDirectory(RunDirectory&& other) noexcept;
    RunDirectory& operator=(RunDirectory&&) = delete;
    ~RunDirectory();

    /// As given, without a slash at the end; once the folder was moved, where it is now. To be asked whenever a file is
    /// opened by name. Errors: DiskError if the folder, or its lock, was removed.
    std::string path() const;
    /// The path of a file in the folder. Errors: as above.
    std::string file(const std::string& name) const { return path() + "/" + name; }
    bool was_moved() const { return path() != path_; }

private:
    std::string path_;
    int lock_ = -1;
};

/// Looks whether a run could have the folder, and touches nothing. Errors: InputError as of RunDirectory.
void require_place_for_run(const std::string& path);

/// Whether the folder was made by a run: it holds run.json, resolved.toml, a checkpoint, or jostle's lock.
///
/// scene.toml alone is no sign: it may be the user's own folder of scenes.
bool is_run_directory(const std::string& path);

/// The same folder by a path that does not depend on the current folder, without "." and "..".
std::string absolute_folder(const std::string& path);

/// For --fresh: renames an existing run folder to PATH.1, or PATH.2 ... if that is taken; nothing is deleted.
///
/// Result: the new name, or "" if there was nothing to move (no such folder, or an empty one).
/// Errors: InputError if another process runs there or if it is no run folder; DiskError.
std::string move_aside(const std::string& path);

}  // namespace jostle
