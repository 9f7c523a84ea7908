#include "frames_so_far.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <random>
#include <string_view>

#include "jostle/disk/durable_file.hpp"
#include "jostle/run_files/checkpoint.hpp"
#include "jostle/run_files/h5md_writer.hpp"
#include "jostle/run_files/trajectory_journal.hpp"

using namespace jostle;
namespace fs = std::filesystem;

namespace {

/// A folder of its own beside the output, gone with all that is in it when this ends. Named and locked as
/// presentation/output_place.py does, so that what a kill leaves is removed by the next report.
class TemporaryFolder {
public:
    explicit TemporaryFolder(const std::string& parent) {
        do path_ = parent + "/.jostle-" + eight_letters() + ".tmp";
        while (::mkdir(path_.c_str(), 0700) < 0 && errno == EEXIST);
        lock_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (lock_ < 0) throw DiskError(parent, "make a folder in it", errno);
        ::flock(lock_, LOCK_EX | LOCK_NB);
    }
    ~TemporaryFolder() {
        std::error_code left;
        fs::remove_all(path_, left);
        ::close(lock_);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::string file(const std::string& name) const { return path_ + "/" + name; }

private:
    static std::string eight_letters() {
        constexpr std::string_view known = "abcdefghijklmnopqrstuvwxyz0123456789_";
        std::random_device random;
        std::string letters;
        for (int k = 0; k < 8; ++k) letters += known[random() % known.size()];
        return letters;
    }

    std::string path_;
    int lock_ = -1;
};

}  // namespace

std::optional<int> frames_so_far(const std::string& folder, const std::string& beside) {
    const std::string made = folder + "/trajectory.h5";
    std::string journal = folder + "/trajectory.journal";
    const bool kept = file_exists(journal);
    if (file_exists(made) && (!kept || fs::last_write_time(made) >= fs::last_write_time(journal))) return std::nullopt;
    if (!file_exists(beside)) return std::nullopt;  // which is for the report to refuse
    const std::optional<Checkpoint> last = kept ? std::nullopt : latest_checkpoint(folder);
    if (!kept && !last) return std::nullopt;
    const TemporaryFolder temporary(beside);
    if (!kept) {
        journal = temporary.file("journal");
        const State& state = last->state;
        TrajectoryJournal::create(journal).append(state.clock.step, state.clock.time, state.box, state.rods);
    }
    const std::string frames = temporary.file("frames.h5");
    write_h5md(journal, frames, {});
    const int file = open(frames.c_str(), O_RDONLY);
    if (file < 0) throw DiskError(frames, "cannot be opened", errno);
    return file;
}
