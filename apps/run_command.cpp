#include "run_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "jostle/io/h5md_writer.hpp"
#include "jostle/io/rods_of_scene.hpp"
#include "jostle/io/scene_reader.hpp"
#include "jostle/io/scene_writer.hpp"
#include "jostle/io/series_columns.hpp"
#include "jostle/io/units.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/simulation/assemble.hpp"
#include "jostle/simulation/largest_overlap.hpp"
#include "jostle/simulation/rod_size.hpp"
#include "jostle/simulation/step_failure.hpp"
#include "post_mortem.hpp"
#include "production_window.hpp"
#include "progress_line.hpp"
#include "run_files.hpp"
#include "run_record.hpp"
#include "stop_request.hpp"
#include "summary.hpp"
#include "summary_text.hpp"
#include "version.hpp"

using namespace jostle;

namespace {

/// Where equilibration has to be detected, a run that has not settled after this many times `production` ends anyhow.
constexpr double longest_run_in_productions = 10.0;
/// How often, in parts of the production time, it is looked whether the series has settled.
constexpr std::size_t looks_per_production = 20;
/// Steps of large assemblies take long: a crash shall cost no more than this.
constexpr std::chrono::minutes longest_between_checkpoints{10};

/// From so many rods on it takes seconds, or minutes, to place them at random.
constexpr std::uint64_t many_to_place = 5000;

/// Decides, from the series alone, when a run has all that it was asked for.
class RunLength {
public:
    RunLength(const Scene& scene, double time_step) : scene_(scene) {
        const double row_time = time_step * static_cast<double>(scene.output.series_every);
        const auto rows = [&](double time) { return static_cast<std::size_t>(std::ceil(time / row_time - 1e-9)); };
        production_rows_ = std::max<std::size_t>(1, rows(scene.time.production));
        if (scene.time.equilibration) fixed_rows_ = rows(*scene.time.equilibration) + production_rows_;
    }

    bool is_over(const SeriesTable& series) {
        if (fixed_rows_ > 0) return series.rows() >= fixed_rows_;
        if (series.rows() < production_rows_ || series.rows() == rows_looked_at_) return false;
        rows_looked_at_ = series.rows();
        const std::size_t look_every = std::max<std::size_t>(1, production_rows_ / looks_per_production);
        if (series.rows() % look_every != 0) return false;
        const ProductionWindow window = production_window(scene_, series);
        if (window.equilibrated && series.rows() - window.first_row >= production_rows_) return true;
        return static_cast<double>(series.rows()) >= longest_run_in_productions * static_cast<double>(production_rows_);
    }

    /// From 0 to 1; with equilibration to be detected, as if it took a quarter of the production.
    double fraction_done(std::size_t rows) const {
        const double expected =
            fixed_rows_ > 0 ? static_cast<double>(fixed_rows_) : 1.25 * static_cast<double>(production_rows_);
        return std::min(1.0, static_cast<double>(rows) / expected);
    }

private:
    const Scene& scene_;
    std::size_t production_rows_ = 1;
    std::size_t fixed_rows_ = 0;  ///< 0: equilibration is detected
    std::size_t rows_looked_at_ = 0;
};

/// A run from its beginning, or from its checkpoint, to its end.
class Run {
public:
    Run(const RunOptions& options, const Scene& scene, std::string resolved, Simulation& simulation, RunFiles& files,
        const RunDirectory& directory, const StepSums& sums)
        : options_(options),
          scene_(scene),
          resolved_(std::move(resolved)),
          simulation_(simulation),
          files_(files),
          directory_(directory),
          sums_(sums),
          length_(scene, simulation.settings().time_step),
          record_(directory.file("run.json"), options),
          progress_(options.quiet || options.json) {}

    ExitCode go() {
        stop_request::wait_for_steps();
        record_.write(simulation_, "running");
        show_progress();
        while (!length_.is_over(files_.series())) {
            if (simulation_.rods().size() == 0) return die_out();
            StepReport report;
            report.step = simulation_.clock().step;
            report.time = simulation_.clock().time;
            try {
                report = simulation_.step();
            } catch (const InputError& error) {  // cells have become what no mobility, or no id, is there for
                report.contacts = simulation_.contacts().size();
                return give_up(report, error.what(), "");
            }
            longest_step_ = std::max(longest_step_, std::accumulate(report.seconds.begin(), report.seconds.end(), 0.0));
            if (const auto failure = step_failure(report, scene_, simulation_.rods()))
                return give_up(report, *failure, advice(report, scene_, simulation_));
            sums_.add(report, simulation_);
            if (scene_.growth.rate > 0.0) files_.append_lineage(simulation_);
            if (simulation_.rods().size() == 0) continue;
            write_what_is_due();
            if (progress_.is_due()) show_progress();
            if (const std::string reason = reason_to_stop(); !reason.empty()) return stop_early(reason);
        }
        return finish();
    }

private:
    void write_what_is_due() {
        const std::uint64_t step = simulation_.clock().step;
        const auto due = [step](std::uint64_t every) { return every > 0 && step % every == 0; };
        if (due(scene_.output.series_every)) {
            sums_.look_at_swimmers(scene_, simulation_);
            files_.append_row(series_row(simulation_, sums_));
            if (scene_.output.contacts) files_.append_contacts(simulation_);
            sums_.start_row();
        }
        if (due(scene_.output.trajectory_every)) files_.append_frame(simulation_);
        if (due(scene_.output.field_every)) {
            files_.append_field(simulation_, *sums_.field);
            sums_.field->clear();
        }
        const bool is_overdue = std::chrono::steady_clock::now() - last_checkpoint_ > longest_between_checkpoints;
        if (due(scene_.output.checkpoint_every) || is_overdue) checkpoint();
    }

    void checkpoint() {
        const auto begin = std::chrono::steady_clock::now();
        files_.write_checkpoint(simulation_, sums_);
        record_.write(simulation_, "running");  // what a session that is killed has done
        last_checkpoint_ = std::chrono::steady_clock::now();
        const std::chrono::duration<double> took = last_checkpoint_ - begin;
        longest_checkpoint_ = std::max(longest_checkpoint_, took.count());
    }

    std::string reason_to_stop() const {
        if (stop_request::signal_received() != 0) return fmt::format("signal {}", stop_request::signal_received());
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - options_.began;
        const double to_be_done = longest_step_ + 3.0 * longest_checkpoint_ + 1.0;
        if (options_.wall_time && elapsed.count() + to_be_done >= *options_.wall_time) return "walltime";
        return "";
    }

    void show_progress() {
        const SeriesTable& series = files_.series();
        const Rods& rods = simulation_.rods();
        const auto last = [&](const char* column) {
            return series.rows() == 0 ? std::nan("") : series.column(column).back();
        };
        progress_.show({simulation_.clock().step, simulation_.clock().time,
                        total_volume(rods) / simulation_.box().volume(), last("Z"),
                        sums_.run_max_overlap / smallest_diameter(scene_, rods), last("iterations"), last("contacts"),
                        length_.fraction_done(series.rows())});
    }

    ExitCode stop_early(const std::string& reason) {
        checkpoint();
        write_trajectory();
        record_.write(simulation_, reason);
        show_progress();
        if (!options_.quiet)
            std::fprintf(stderr, "\njostle: stopped at step %llu (%s); run the same command again to go on\n",
                         static_cast<unsigned long long>(simulation_.clock().step), reason.c_str());
        return ExitCode::stopped_early;
    }

    /// All cells have died: there is nothing to average.
    ExitCode die_out() {
        checkpoint();
        write_trajectory();
        record_.write(simulation_, "extinct");
        if (options_.json) std::printf("%s\n", R"({"rods": 0, "exit_reason": "extinct"})");
        std::fprintf(stderr, "jostle: all cells have died by step %llu\n",
                     static_cast<unsigned long long>(simulation_.clock().step));
        return ExitCode::done;
    }

    ExitCode give_up(const StepReport& report, const std::string& failure, const std::string& advice) {
        write_post_mortem(directory_.file("post_mortem.json"), simulation_, report, failure);
        write_trajectory();
        record_.write(simulation_, failure);
        std::fprintf(stderr, "jostle: step %llu failed: %s\n%s  details: %s\n",
                     static_cast<unsigned long long>(report.step), failure.c_str(), advice.c_str(),
                     directory_.file("post_mortem.json").c_str());
        return ExitCode::numerics;
    }

    ExitCode finish() {
        checkpoint();
        write_trajectory();
        const double overlap = std::max(sums_.run_max_overlap, largest_overlap(simulation_.rods(), simulation_.box()));
        const auto summary = summarise(scene_, simulation_, files_.series(), overlap);
        replace_file(directory_.file("summary.json"), summary.dump(2) + "\n");
        record_.write(simulation_, "done");
        show_progress();
        if (options_.json)
            std::printf("%s\n", summary.dump(2).c_str());
        else if (!options_.quiet)
            std::printf("%s%s\n", summary_text(summary).c_str(), ("files in " + directory_.path()).c_str());
        return ExitCode::done;
    }

    void write_trajectory() const {
        if (!files_.has_trajectory()) return;
        H5mdAttributes attributes;
        attributes.version = jostle_version;
        attributes.scene = read_file(directory_.file("scene.toml"));
        attributes.resolved_scene = resolved_;
        attributes.seed = scene_.seed;
        attributes.command_line = options_.command_line;
        attributes.host = host_name();
        attributes.unit_system = scene_.units.system == UnitSystem::micro ? "SI" : "reduced";
        attributes.length_unit = unit_of(scene_, dimension::length);
        attributes.time_unit = unit_of(scene_, dimension::time);
        attributes.stress_unit = unit_of(scene_, dimension::stress);
        attributes.energy_unit = unit_of(scene_, dimension::energy);
        attributes.kT = simulation_.settings().kT;
        write_h5md(directory_.file("trajectory.journal"), directory_.file("trajectory.h5"), attributes,
                   &files_.series());
    }

    const RunOptions& options_;
    const Scene& scene_;
    std::string resolved_;
    Simulation& simulation_;
    RunFiles& files_;
    const RunDirectory& directory_;
    StepSums sums_;
    RunLength length_;
    RunRecord record_;
    ProgressLine progress_;
    std::chrono::steady_clock::time_point last_checkpoint_ = std::chrono::steady_clock::now();
    double longest_step_ = 0.0, longest_checkpoint_ = 0.0;  ///< s
};

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

ExitCode start_run(const RunOptions& options, const Scene& scene, const std::string& resolved,
                   const std::string& folder) {
    const bool draws = scene.rods.start == StartKind::random || scene.rods.start == StartKind::aligned;
    if (draws && scene.rods.count >= many_to_place && !options.quiet && !options.json)
        std::fprintf(stderr, "jostle: placing %llu rods without overlap\n",
                     static_cast<unsigned long long>(scene.rods.count));
    // The start is made before anything is touched on the disk: a scene that does not work out leaves no trace.
    Beginning beginning = beginning_of(scene, options.scene);
    Simulation simulation = assemble(scene, beginning.box, std::move(beginning.rods), {}, std::move(beginning.springs));
    const std::string text = read_file(options.scene);  // which may lie in the folder that is moved aside
    if (options.fresh) {
        const std::string moved_to = move_aside(folder);
        if (!moved_to.empty() && !options.quiet)
            std::fprintf(stderr, "jostle: the run that was in %s is now in %s\n", folder.c_str(), moved_to.c_str());
    }
    const RunDirectory directory(folder);
    replace_file(directory.file("scene.toml"), text);
    replace_file(directory.file("resolved.toml"), resolved);
    const StepSums sums = first_sums(scene, simulation);
    RunFiles files(directory, scene, resolved, simulation, sums);
    return Run(options, scene, resolved, simulation, files, directory, sums).go();
}

ExitCode resume_run(const RunOptions& options, const Scene& scene, const std::string& resolved,
                    const RunDirectory& directory, Checkpoint checkpoint) {
    require_same_scene(checkpoint, resolved, directory.path());
    require_same_springs(checkpoint, springs_from_file(scene, options.scene, checkpoint.rods),
                         springs_path(scene, options.scene));
    const StepSums sums = StepSums::from_numbers(checkpoint.accumulators);
    RunFiles files(directory, scene, resolved, checkpoint);
    if (checkpoint.scene != resolved) {  // another end
        replace_file(directory.file("scene.toml"), read_file(options.scene));
        replace_file(directory.file("resolved.toml"), resolved);
    }
    Simulation simulation =
        assemble(scene, checkpoint.box, std::move(checkpoint.rods), {checkpoint.step, checkpoint.time},
                 std::move(checkpoint.springs), std::move(checkpoint.last_forces));
    if (!options.quiet && !options.json)
        std::fprintf(stderr, "jostle: going on from step %llu\n", static_cast<unsigned long long>(checkpoint.step));
    return Run(options, scene, resolved, simulation, files, directory, sums).go();
}

}  // namespace

ExitCode run_command(const RunOptions& options) {
    stop_request::install();
    if (options.threads > 0) parallel::set_thread_count(options.threads);
    const Scene scene = read_scene(options.scene);
    const std::string resolved = to_toml(scene);
    const std::string folder = folder_for(options);
    if (!options.fresh && is_run_directory(folder)) {
        const RunDirectory directory(folder);
        if (auto checkpoint = latest_checkpoint(folder))
            return resume_run(options, scene, resolved, directory, std::move(*checkpoint));
        if (has_rows(directory.file("series.csv")))
            throw refused_file(folder, "this run has results but no checkpoint to go on from",
                               "Start anew with --fresh: the old run is then moved aside, not deleted");
    }
    return start_run(options, scene, resolved, folder);
}
