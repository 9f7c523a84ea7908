#include "launched_run.hpp"

#include <fmt/format.h>

#include "jostle/measurement/measurement.hpp"
#include "jostle/parallel/launched_ranks.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/scene_file/scene_reader.hpp"
#include "jostle/setup/assemble.hpp"
#include "run.hpp"
#include "stop_request.hpp"

using namespace jostle;

namespace {

/// The run of a rank that is not the first.
ExitCode accompany(const RunOptions& options, Together& together) {
    if (options.threads) parallel::set_thread_count(*options.threads, "--threads");
    parallel::thread_count();  // looks at OMP_NUM_THREADS: what only this rank meets is no error of a start
    std::optional<Checkpoint> told = together.wait_for_first(options.scene);
    if (!told) return ExitCode::done;
    RunScene scene{options.scene, std::move(told->scene), {}, {}};
    scene.scene = parse_scene(scene.text, scene.path);
    StepSums sums = StepSums::from_named(std::move(told->sums), scene.scene, told->state.box);
    Simulation simulation = assemble(scene.scene, std::move(told->state));
    told.reset();
    Measurement measurement(scene.scene, simulation, std::move(sums));
    return Run(options, scene, simulation, measurement, together).go();
}

}  // namespace

ExitCode launched_run(const RunOptions& options, const std::function<ExitCode(Together&)>& first) {
    const bool is_first = launch_in_environment().rank == 0;  // which tells
    if (!is_first) stop_request::say_nothing();
    if (!LaunchedRanks::are_built_in() && !is_first) return ExitCode::bad_input;
    LaunchedRanks launched;
    const Ranks ranks = launched.ranks();
    parallel::share_processors(launched.on_this_machine());
    Together together(ranks);
    bool has_ended = false;
    const auto play_part = [&] {
        require_same_command(ranks, options);
        const ExitCode code = together.is_first() ? first(together) : accompany(options, together);
        has_ended = true;
        return code;
    };
    const std::string who = together.is_first() ? "" : fmt::format("rank {} of {}: ", ranks.rank(), ranks.count());
    const int code = exit_status(play_part, who);
    stop_request::say_nothing();  // a launcher may end those that are left by a signal: all has been said
    using enum Together::Others;
    if (together.is_first() && together.others() == wait)
        together.call_off();
    else if (!has_ended && together.others() != leave)
        launched.give_up(code);
    return static_cast<ExitCode>(static_cast<int>(ranks.largest(code)));
}
