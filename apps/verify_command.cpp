#include "verify_command.hpp"

#include <cstdio>
#include <optional>
#include <string_view>

#include "jostle/run_files/checkpoint.hpp"
#include "jostle/run_files/h5md_writer.hpp"
#include "jostle/run_files/run_directory.hpp"
#include "jostle/run_files/series_file.hpp"
#include "jostle/run_files/trajectory_journal.hpp"
#include "verify_texts.hpp"

using namespace jostle;

namespace {

std::uint64_t count_frames(const std::string& path) {
    TrajectoryReader reader(path);
    TrajectoryFrame frame;
    std::uint64_t frames = 0;
    while (reader.next(frame)) ++frames;
    return frames;
}

/// The files that the checkpoint stands for, up to where they had come.
void verify_growing_files(const std::string& folder, const Checkpoint& checkpoint) {
    for (const auto& [name, position] : checkpoint.files) {
        const std::string path = folder + "/" + name;
        if (name == trajectory_journal_name)
            TrajectoryJournal::require_frames(path, position.bytes, position.hash);
        else
            require_same_bytes(path, position.bytes, position.hash);
    }
}

}  // namespace

ExitCode verify_command(const std::string& folder) {
    if (!is_run_directory(folder))
        throw refused_file(folder, "this is not the folder of a run", "Give the folder that `jostle run` named");
    const auto path = [&](const char* name) { return folder + "/" + name; };
    std::optional<Checkpoint> latest;
    for (const char* name : {"checkpoint.previous", "checkpoint"}) {
        if (!file_exists(path(name))) continue;
        latest =
            std::string_view(name) == "checkpoint" ? latest_checkpoint(folder).value() : read_checkpoint(path(name));
        verify_growing_files(folder, *latest);
        std::printf("%s: sound, step %llu\n", name, static_cast<unsigned long long>(latest->state.clock.step));
    }
    if (file_exists(path("series.csv")))
        std::printf("series.csv: sound, %zu rows\n", read_series(path("series.csv")).rows());
    if (file_exists(path("trajectory.journal")))
        std::printf("trajectory.journal: sound, %llu frames\n",
                    static_cast<unsigned long long>(count_frames(path("trajectory.journal"))));
    if (file_exists(path("trajectory.h5"))) {
        verify_h5md(path("trajectory.h5"));
        std::printf("trajectory.h5: sound\n");
    }
    if (latest) verify_texts(folder, *latest);
    return ExitCode::done;
}
