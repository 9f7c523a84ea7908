#include "run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "jostle/disk/checksum.hpp"
#include "jostle/disk/durable_file.hpp"
#include "jostle/measurement/h5md_attributes.hpp"
#include "jostle/parallel/freed_memory.hpp"
#include "jostle/scene/rod_size.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/setup/largest_overlap.hpp"
#include "jostle/setup/step_failure.hpp"
#include "post_mortem.hpp"
#include "sealed_json.hpp"
#include "stop_request.hpp"
#include "summary_text.hpp"

using namespace jostle;

namespace {

/// Steps of large assemblies take long: a crash shall cost no more than this.
constexpr std::chrono::minutes longest_between_checkpoints{10};
/// Wall time kept for the end of a run, beside its last checkpoint: between two steps, and within one (s). Of a short
/// wall time a part is left for a step: a run that is started again and again shall get on.
constexpr double kept_between_steps = 1.0, kept_within_step = 0.5, largest_part_kept = 0.25;

H5mdAttributes trajectory_attributes(const RunScene& run_scene, const std::string& command_line) {
    H5mdAttributes attributes = h5md_attributes(run_scene.scene);
    attributes.scene = run_scene.text;
    attributes.resolved_scene = run_scene.resolved;
    attributes.command_line = command_line;
    attributes.host = host_name();
    return attributes;
}

}  // namespace

Run::Run(const RunOptions& options, const RunScene& scene, Simulation& simulation, Measurement& measurement,
         const Together& together, RunFiles* files, const RunDirectory* directory, nlohmann::ordered_json start)
    : options_(options),
      run_scene_(scene),
      scene_(scene.scene),
      simulation_(simulation),
      measurement_(measurement),
      ranks_(together.ranks()),
      files_(files),
      contact_columns_(contact_columns(scene_)),
      directory_(directory),
      volume_fraction_(total_volume(simulation.rods(), simulation.box().dimensions()) / simulation.box().volume()),
      thinnest_(smallest_diameter(scene_, simulation.rods())),
      progress_(options.quiet || options.json || !files) {
    if (directory) record_.emplace(*directory, options, together, std::move(start));
    simulation_.interrupt_when(
        [this, kept = std::min(kept_within_step, largest_part_kept * options.wall_time.value_or(0.0))] {
            return stop_request::signal_received() != 0 || wall_time_is_over(kept);
        });
}

ExitCode Run::go() {
    stop_request::wait_for_steps();
    parallel::keep_freed_memory();
    record("running");
    show_progress();
    share();
    Decision now = decide();
    while (!now.is_complete) {
        if (simulation_.rods_in_all() == 0) return die_out();
        StepReport report;
        report.step = simulation_.clock().step;
        report.time = simulation_.clock().time;
        try {
            report = simulation_.step();
        } catch (const InputError& error) {  // cells have become what no mobility, or no id, is there for
            if (!ranks_.alone()) throw;      // the others know nothing of it
            report.contacts = simulation_.contacts().size();
            return give_up(report, error.what(), "");
        }
        find_thinnest();
        if (report.status == LcpStatus::interrupted) return stop_early(decide().reason_to_stop);
        longest_step_ = std::max(longest_step_, std::accumulate(report.seconds.begin(), report.seconds.end(), 0.0));
        if (const auto failure = step_failure(report, scene_, thinnest()))
            return give_up(report, *failure, advice(report, scene_, simulation_));
        const Due due = measurement_.add(report, simulation_);
        require_same(report, due);
        if (grows(scene_) && is_first()) files_->append_lineage(simulation_);
        if (simulation_.rods_in_all() > 0) {
            write_what_is_due(due, now.checkpoint_is_overdue);
            if (progress_.is_due()) show_progress();
        }
        now = decide();
        if (simulation_.rods_in_all() > 0 && !now.reason_to_stop.empty()) return stop_early(now.reason_to_stop);
    }
    return finish();
}

/// From here to `is_alone` every rank has its part of the rods.
void Run::share() {
    if (ranks_.alone()) return;
    measurement_.share(ranks_);
    simulation_.share(ranks_);
    simulation_.exchange_once_in(options_.colours_per_exchange);
}

/// Whether this rank ends the run by itself, with all rods; the others have done their part.
bool Run::is_alone() {
    simulation_.unite();
    ranks_ = {};
    return is_first();
}

double Run::thinnest() const {
    return ranks_.alone() ? smallest_diameter(scene_, simulation_.rods()) : thinnest_;
}

/// Cells that die may have been the thinnest of all ranks'.
void Run::find_thinnest() {
    if (ranks_.alone() || !grows(scene_) || simulation_.rods_in_all() == 0) return;
    const Rods& rods = simulation_.rods();
    const double of_rank = rods.size() == 0 ? INFINITY : smallest_diameter(scene_, rods);
    thinnest_ = -ranks_.largest(-of_rank);
}

/// Signals may have reached any rank; clocks, and what there is of the series, are those of the first.
Run::Decision Run::decide() {
    const bool late = is_first() && wall_time_is_over(longest_step_ + kept_between_steps);
    const bool complete = is_first() && measurement_.is_complete();
    const bool overdue = std::chrono::steady_clock::now() - last_checkpoint_ > longest_between_checkpoints;
    std::array<double, 4> all = {static_cast<double>(stop_request::signal_received()), late ? 1.0 : 0.0,
                                 complete ? 1.0 : 0.0, is_first() && overdue ? 1.0 : 0.0};
    ranks_.largest(all);
    Decision decision = {all[2] > 0.0, all[3] > 0.0};
    if (all[0] > 0.0)
        decision.reason_to_stop = fmt::format("signal {:.0f}", all[0]);
    else if (all[1] > 0.0)
        decision.reason_to_stop = "walltime";
    return decision;
}

/// A bit that is lost on one rank would make of the run something that no number of ranks gives.
void Run::require_same(const StepReport& report, const Due& due) {
    if (ranks_.alone()) return;
    std::vector<double> known = {static_cast<double>(report.step),
                                 report.time,
                                 static_cast<double>(report.rods),
                                 report.residual,
                                 static_cast<double>(report.iterations),
                                 static_cast<double>(report.contacts),
                                 static_cast<double>(report.active_contacts),
                                 report.max_overlap};
    for (const Mat3* virial : {&report.collision_virial, &report.torque_virial})
        known.insert(known.end(), virial->m.begin(), virial->m.end());
    if (due.row) {
        const std::vector<double> row = measurement_.last_row();
        known.insert(known.end(), row.begin(), row.end());
    }
    const std::string_view bytes(reinterpret_cast<const char*>(known.data()), known.size() * sizeof(double));
    if (ranks_.all_have(jostle::checksum(bytes))) return;
    throw std::runtime_error(fmt::format(
        "ranks have come to different results in step {}: a machine or its memory is at fault, or their libraries "
        "differ. The run goes on from its last checkpoint",
        report.step));
}

void Run::write_what_is_due(const Due& due, bool checkpoint_is_overdue) {
    if (due.row && is_first()) files_->append_row(measurement_.last_row());
    if (due.row && scene_.output.contacts) {
        const TableRows rows = contact_rows(contact_columns_, simulation_);
        if (is_first()) files_->append_contacts(rows);
    }
    if (due.frame) append_frame();
    if (due.field && is_first()) files_->append_field(measurement_.last_field());
    if (due.checkpoint || checkpoint_is_overdue) checkpoint();
}

RodsInOrder Run::rods_for_files() const {
    const bool many = static_cast<double>(simulation_.rods_in_all()) > options_.ranks_write_above;
    return simulation_.rods_in_order(many ? RodsInOrder::TakenBy::all_ranks : RodsInOrder::TakenBy::first_rank);
}

void Run::append_frame() {
    const RodsInOrder rods = rods_for_files();
    std::vector<Mat3> stress;
    if (scene_.output.stress_per_rod)
        stress = stress_of_last_step(simulation_, rods.all_take() ? simulation_.rods_in_order() : rods);
    if (is_first())
        files_->append_frame(simulation_, rods, stress);
    else
        TrajectoryJournal::send_rods(rods);
}

void Run::checkpoint() {
    const auto begin = std::chrono::steady_clock::now();
    Checkpoint now = checkpoint_without_rods(simulation_, measurement_.sums(), run_scene_.resolved);
    const RodsInOrder rods = rods_for_files();
    last_checkpoint_ = std::chrono::steady_clock::now();
    if (!is_first()) return send_rods_of_checkpoint(rods);
    files_->write_checkpoint(std::move(now), rods);
    record("running");  // what a session that is killed has done
    last_checkpoint_ = std::chrono::steady_clock::now();
    const std::chrono::duration<double> took = last_checkpoint_ - begin;
    longest_checkpoint_ = std::max(longest_checkpoint_, took.count());
}

void Run::record(const std::string& exit_reason) {
    if (record_) record_->write(simulation_, exit_reason);
}

/// `still_to_be_done`: seconds before the last checkpoint can be written.
bool Run::wall_time_is_over(double still_to_be_done) const {
    if (!options_.wall_time || !is_first()) return false;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - options_.began;
    return elapsed.count() + 3.0 * longest_checkpoint_ + still_to_be_done >= *options_.wall_time;
}

void Run::show_progress(const std::string& remark) {
    if (!is_first()) return;
    const SeriesTable& series = measurement_.series();
    const auto last = [&](const char* column) {
        return series.rows() == 0 ? std::nan("") : series.column(column).back();
    };
    // Of ranks each knows its own rods: all together have measured the last row.
    const double filled =
        ranks_.alone() ? total_volume(simulation_.rods(), simulation_.box().dimensions()) / simulation_.box().volume()
        : series.rows() == 0 ? volume_fraction_
                             : last("phi");
    progress_.show({simulation_.clock().step, simulation_.clock().time, filled, last("Z"),
                    measurement_.sums().run_max_overlap / thinnest(), last("iterations"), last("contacts"),
                    measurement_.fraction_done(), grows(run_scene_.scene), remark});
}

void Run::write_trajectory() const {
    if (!files_->has_trajectory()) return;
    write_h5md(directory_->file("trajectory.journal"), directory_->file("trajectory.h5"),
               trajectory_attributes(run_scene_, options_.command_line), &measurement_.series());
}

/// The last line: where the files are, and how to look at them.
std::string Run::files_and_report() const {
    const std::string folder = directory_->path();
    const bool plain =
        folder.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,/") ==
        std::string::npos;
    return fmt::format("files in {}; to look at them: jostle report {}", folder, plain ? folder : "'" + folder + "'");
}

ExitCode Run::stop_early(const std::string& reason) {
    checkpoint();
    if (!is_alone()) return ExitCode::done;
    write_trajectory();
    record(reason);
    show_progress();
    const std::string how = directory_->was_moved() ? "its folder was moved: to go on give --out " + directory_->path()
                                                    : "run the same command again to go on";
    if (!options_.quiet)
        std::fprintf(stderr, "\njostle: stopped at step %llu (%s); %s\n",
                     static_cast<unsigned long long>(simulation_.clock().step), reason.c_str(), how.c_str());
    return ExitCode::stopped_early;
}

/// All cells have died: there is nothing to average.
ExitCode Run::die_out() {
    checkpoint();
    if (!is_alone()) return ExitCode::done;
    write_trajectory();
    record("extinct");
    if (options_.json) std::printf("%s\n", R"({"rods": 0, "exit_reason": "extinct"})");
    std::fprintf(stderr, "jostle: all cells have died by step %llu\n",
                 static_cast<unsigned long long>(simulation_.clock().step));
    return ExitCode::done;
}

ExitCode Run::give_up(const StepReport& report, const std::string& failure, const std::string& advice) {
    if (!is_alone()) return ExitCode::done;
    write_post_mortem(directory_->file("post_mortem.json"), simulation_, report, failure);
    write_trajectory();
    record(failure);
    std::fprintf(stderr, "jostle: step %llu failed: %s\n%s  details: %s\n",
                 static_cast<unsigned long long>(report.step), failure.c_str(), advice.c_str(),
                 directory_->file("post_mortem.json").c_str());
    return ExitCode::numerics;
}

ExitCode Run::finish() {
    checkpoint();
    if (!is_alone()) return ExitCode::done;
    StepReport last;  // steps report the overlap with which they begin: that of the end is nobody's yet
    last.step = simulation_.clock().step;
    last.time = simulation_.clock().time;
    last.max_overlap = largest_overlap(simulation_.rods(), simulation_.box());
    if (const auto failure = step_failure(last, scene_, thinnest()))
        return give_up(last, *failure, advice(last, scene_, simulation_));
    write_trajectory();
    const auto summary = measurement_.summary(simulation_);
    const std::string text = sealed_json(summary);
    replace_file(directory_->file("summary.json"), text);
    record("done");
    const bool known = summary["equilibrated"].get<bool>() || grows(scene_);
    show_progress(known ? "" : summary["equilibrium"]["in_words"].get<std::string>());
    if (options_.json)
        std::fputs(text.c_str(), stdout);
    else if (!options_.quiet)
        std::printf("%s%s\n", summary_text(summary, scene_).c_str(), files_and_report().c_str());
    return ExitCode::done;
}
