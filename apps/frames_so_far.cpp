#include "frames_so_far.hpp"

#include <fcntl.h>
#include <stdlib.h>

#include <filesystem>

#include "jostle/io/checkpoint.hpp"
#include "jostle/io/durable_file.hpp"
#include "jostle/io/h5md_writer.hpp"
#include "jostle/io/trajectory_journal.hpp"

using namespace jostle;
namespace fs = std::filesystem;

namespace {

/// A folder of its own, gone with all that is in it when this ends.
class TemporaryFolder {
public:
    TemporaryFolder() {
        if (mkdtemp(path_.data()) == nullptr) throw DiskError(path_, "cannot make a temporary folder", errno);
    }
    ~TemporaryFolder() {
        std::error_code left;
        fs::remove_all(path_, left);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::string file(const std::string& name) const { return path_ + "/" + name; }

private:
    std::string path_ = (fs::temp_directory_path() / "jostle.XXXXXX").string();
};

}  // namespace

std::optional<int> frames_so_far(const std::string& folder) {
    const std::string made = folder + "/trajectory.h5";
    std::string journal = folder + "/trajectory.journal";
    const bool kept = file_exists(journal);
    if (file_exists(made) && (!kept || fs::last_write_time(made) >= fs::last_write_time(journal))) return std::nullopt;
    const TemporaryFolder temporary;
    if (!kept) {
        const std::optional<Checkpoint> last = latest_checkpoint(folder);
        if (!last) return std::nullopt;
        journal = temporary.file("journal");
        TrajectoryJournal::create(journal).append(last->step, last->time, last->box, last->rods);
    }
    const std::string frames = temporary.file("frames.h5");
    write_h5md(journal, frames, {});
    const int file = open(frames.c_str(), O_RDONLY);
    if (file < 0) throw DiskError(frames, "cannot be opened", errno);
    return file;
}
