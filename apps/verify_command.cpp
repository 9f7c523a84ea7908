#include "verify_command.hpp"

#include <cstdio>

#include "jostle/error/input_error.hpp"
#include "jostle/io/checkpoint.hpp"
#include "jostle/io/h5md_writer.hpp"
#include "jostle/io/run_directory.hpp"
#include "jostle/io/scene_reader.hpp"
#include "jostle/io/series_file.hpp"
#include "jostle/io/trajectory_journal.hpp"
#include "series_columns.hpp"

using namespace jostle;

namespace {

std::uint64_t count_frames(const std::string& path) {
    TrajectoryReader reader(path);
    TrajectoryFrame frame;
    std::uint64_t frames = 0;
    while (reader.next(frame)) ++frames;
    return frames;
}

void verify_series(const std::string& path, const Checkpoint& checkpoint) {
    const UnitSystem units = parse_scene(checkpoint.scene, "scene of the checkpoint").units.system;
    SeriesFile::require_prefix(path, series_columns(units), checkpoint.series_bytes, checkpoint.series_hash);
}

}  // namespace

ExitCode verify_command(const std::string& folder) {
    if (!is_run_directory(folder))
        throw refused_file(folder, "this is not the folder of a run", "Give the folder that `jostle run` named");
    const auto path = [&](const char* name) { return folder + "/" + name; };
    for (const char* name : {"checkpoint.previous", "checkpoint"}) {
        if (!file_exists(path(name))) continue;
        const Checkpoint checkpoint = read_checkpoint(path(name));
        verify_series(path("series.csv"), checkpoint);
        std::printf("%s: sound, step %llu\n", name, static_cast<unsigned long long>(checkpoint.step));
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
    return ExitCode::done;
}
