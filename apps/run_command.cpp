#include "run_command.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "jostle/disk/durable_file.hpp"
#include "jostle/parallel/launched_ranks.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/scene_file/rods_of_scene.hpp"
#include "jostle/scene_file/same_scene.hpp"
#include "jostle/scene_file/scene_reader.hpp"
#include "jostle/scene_file/scene_settings.hpp"
#include "jostle/scene_file/scene_writer.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"
#include "launched_run.hpp"
#include "run.hpp"
#include "start_entry.hpp"
#include "start_watch.hpp"

using namespace jostle;

namespace {

/// From so many rods on it takes seconds, or minutes, to place them at random.
constexpr std::uint64_t many_to_place = 5000;

RunScene read_run_scene(const std::string& path, const std::vector<Setting>& settings) {
    RunScene scene{path, with_settings(read_scene_text(path), path, settings), {}, {}};
    scene.scene = parse_scene(scene.text, path);
    scene.resolved = to_toml(scene.scene);
    return scene;
}

std::string folder_for(const RunOptions& options) {
    if (!options.folder.empty()) return options.folder;
    return std::filesystem::path(options.scene).stem().string() + ".run";
}

/// Whether a series has rows below its header. The first checkpoint is older than the first row.
bool has_rows(const std::string& series) {
    std::ifstream file(series);
    std::string line;
    std::getline(file, line);
    std::getline(file, line);
    return file.good();  // a line that has no end is no row
}

void write_scene(const RunScene& scene, const RunDirectory& directory) {
    replace_file(directory.file("scene.toml"), scene.text);
    replace_file(directory.file("resolved.toml"), scene.resolved);
}

/// For those who look at the run.
void write_fixed_rods(const Box& box, const RunDirectory& directory) {
    if (!box.fixed_rods()) return;
    const Rods& fixed = *box.fixed_rods();
    std::string text = "x,y,z,nx,ny,nz,length,diameter\n";
    for (std::size_t f = 0; f < fixed.size(); ++f) {
        const Vec3 &r = fixed.centre[f], &n = fixed.axis[f];
        text +=
            fmt::format("{},{},{},{},{},{},{},{}\n", r.x, r.y, r.z, n.x, n.y, n.z, fixed.length[f], fixed.diameter[f]);
    }
    replace_file(directory.file("fixed.csv"), text);
}

/// Moves what is in the folder aside. Result: the folder, by a name that does not follow what was moved, as "." would.
std::string freed(const std::string& folder, bool quiet) {
    const std::string place = absolute_folder(folder);
    const std::string moved_to = move_aside(place);
    if (moved_to.empty()) return folder;
    if (!quiet) std::fprintf(stderr, "jostle: the run that was in %s is now in %s\n", folder.c_str(), moved_to.c_str());
    return place;
}

ExitCode start_run(const RunOptions& options, const RunScene& scene, std::string folder, Together& together) {
    together.require_ready(scene.scene);  // before the time that a dense start takes
    require_place_for_run(folder);
    const std::uint64_t count = scene.scene.rods.count;
    if (places_are_drawn(scene.scene) && count >= many_to_place && !options.quiet && !options.json)
        std::fprintf(stderr, "jostle: placing %llu rods without overlap\n", static_cast<unsigned long long>(count));
    // The start is made before anything is touched on the disk: a scene that does not work out leaves no trace.
    StartWatch watch(options);
    Beginning beginning = beginning_of(
        scene.scene, scene.path, [&](const Annealing& now) { watch.see(now); },
        [&](const Box& box, const std::optional<Rods>& from_file, const AnnealingWatch& see) {
            return together.make_start(scene, box, from_file, see);
        });
    const nlohmann::ordered_json start = start_entry(scene.scene, beginning);
    if (!options.quiet && !options.json) std::fputs(start_text(start, watch.seconds()).c_str(), stderr);
    Simulation simulation = assemble(scene.scene, std::move(beginning.state));
    if (options.fresh) folder = freed(folder, options.quiet);
    const RunDirectory directory(folder);
    write_scene(scene, directory);
    write_fixed_rods(simulation.box(), directory);
    Measurement measurement(scene.scene, simulation);
    RunFiles files(directory, scene.scene, scene.resolved, simulation, measurement.sums());
    together.begin(scene, simulation, measurement.sums());
    return Run(options, scene, simulation, measurement, together, &files, &directory, start).go();
}

ExitCode resume_run(const RunOptions& options, const RunScene& scene, const RunDirectory& directory,
                    Checkpoint checkpoint, Together& together) {
    require_same_scene(checkpoint, scene.scene, directory.path());
    together.require_ready(scene.scene);
    require_same_springs(checkpoint,
                         in_scene_file(scene.path,
                                       [&] {
                                           const Rods& rods = checkpoint.state.rods;
                                           return springs_from_file(scene.scene, scene.path, rods, rods.size());
                                       }),
                         scene.scene.motion.reversal_rate > 0.0, springs_path(scene.scene, scene.path));
    require_same_fixed_rods(checkpoint, in_scene_file(scene.path, [&] { return fixed_rods(scene.scene, scene.path); }),
                            scene.scene.rods.fixed);
    StepSums sums = StepSums::from_named(std::move(checkpoint.sums), scene.scene, checkpoint.state.box);
    Simulation simulation = assemble(scene.scene, std::move(checkpoint.state));
    RunFiles files(directory, scene.scene, simulation, checkpoint.files);
    write_scene(scene, directory);  // it may have another end, and what was there may be damaged
    write_fixed_rods(simulation.box(), directory);
    if (!options.quiet && !options.json)
        std::fprintf(stderr, "jostle: going on from step %llu\n",
                     static_cast<unsigned long long>(checkpoint.state.clock.step));
    Measurement measurement(scene.scene, simulation, std::move(sums), read_series(directory.file("series.csv")));
    together.begin(scene, simulation, measurement.sums());
    return Run(options, scene, simulation, measurement, together, &files, &directory).go();
}

ExitCode start_or_resume(const RunOptions& options, const std::vector<Setting>& settings, Together& together) {
    const RunScene scene = read_run_scene(options.scene, settings);
    if (has_sweep(scene.text) && !options.quiet && !options.json)
        std::fputs("jostle: one run of the scene; what its [sweep] asks for is run by `jostle sweep`\n", stderr);
    const std::string folder = folder_for(options);
    if (!options.fresh && is_run_directory(folder)) {
        const RunDirectory directory(folder);
        if (auto checkpoint = latest_checkpoint(directory.path()))
            return resume_run(options, scene, directory, std::move(*checkpoint), together);
        if (has_rows(directory.file("series.csv")))
            throw refused_file(folder, "this run has results but no checkpoint to go on from",
                               "Start anew with --fresh: the old run is then moved aside, not deleted");
    }
    return start_run(options, scene, folder, together);
}

ExitCode make_run(const RunOptions& options, Together& together) {
    if (options.threads) parallel::set_thread_count(*options.threads, "--threads");
    parallel::thread_count();  // looks at OMP_NUM_THREADS before anything is written
    const std::vector<Setting> settings = parse_settings(options.settings);
    try {
        return in_settings(options.scene, settings, [&] { return start_or_resume(options, settings, together); });
    } catch (const StartOutOfTime& late) {
        std::fprintf(stderr, "jostle: %s\n", late.what());
        return ExitCode::bad_input;  // the same again would come no farther
    }
}

}  // namespace

ExitCode run_command(const RunOptions& options) {
    if (!options.alone && launch_in_environment().is_of_several())
        return launched_run(options, [&](Together& together) { return make_run(options, together); });
    Together alone;
    return make_run(options, alone);
}
