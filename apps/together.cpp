#include "together.hpp"

#include <algorithm>

#include "jostle/disk/checksum.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/run_files/version.hpp"
#include "jostle/scene/pressure_control.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene_file/scene_reader.hpp"
#include "jostle/setup/start.hpp"
#include "run_record.hpp"
#include "start_watch.hpp"

using namespace jostle;

namespace {

/// What the first tells begins with: what is to be made of it.
constexpr char a_start = 's', a_run = 'r';

std::vector<std::string> hosts_of(const Ranks& ranks) {
    const std::string own = host_name();
    std::vector<std::vector<char>> to(static_cast<std::size_t>(ranks.count()));
    to[0].assign(own.begin(), own.end());
    std::vector<std::string> hosts;
    for (const auto& name : ranks.deal(to)) hosts.emplace_back(name.begin(), name.end());
    std::sort(hosts.begin(), hosts.end());
    hosts.erase(std::unique(hosts.begin(), hosts.end()), hosts.end());
    return hosts;
}

}  // namespace

Together::Together(const Ranks& ranks) : ranks_(ranks), hosts_(hosts_of(ranks)) {}

void Together::require_ready(const Scene& scene) const {
    if (ranks_.alone()) return;
    const auto refuse_if = [](bool is_asked_for, const char* key, const char* what) {
        if (is_asked_for)
            throw InputError({.key = key,
                              .problem = std::string(what) + " not ready for several ranks",
                              .suggestion = "Start the run without a launcher, or without the key"});
    };
    refuse_if(grows(scene) && swims(scene), "growth.rate", "swimmers that grow are");
    refuse_if(compresses(scene) && !is_piston(scene), "pressure.external", "compression without thermal motion is");
    refuse_if(scene.mobility.model == MobilityModel::hydrodynamic, "mobility.model", "rods that a fluid couples are");
    refuse_if(scene.solver.method != SolverMethod::automatic && scene.solver.method != SolverMethod::projected_sor,
              "solver.method", "solvers for comparison are");
}

Rods Together::make_start(const RunScene& scene, const Box& box, const std::optional<Rods>& from_file,
                          const AnnealingWatch& watch) {
    if (ranks_.alone() || !places_are_drawn(scene.scene)) return jostle::make_start(scene.scene, box, from_file, watch);
    const Rods none;
    ranks_.of_first(a_start + packed({scene.text, {box, {}}, {}, {}}, none));
    others_ = Others::work;
    try {
        Rods rods = jostle::make_start(scene.scene, box, from_file, watch, ranks_);
        others_ = Others::wait;
        return rods;
    } catch (const InputError&) {
        others_ = Others::leave;
        throw;
    } catch (const StartOutOfTime&) {
        others_ = Others::leave;
        throw;
    }
}

void Together::begin(const RunScene& scene, const Simulation& simulation, const StepSums& sums) {
    others_ = Others::work;
    if (ranks_.alone()) return;
    ranks_.of_first(a_run + packed(checkpoint_without_rods(simulation, sums, scene.text), simulation.rods_in_order()));
}

void Together::call_off() const {
    ranks_.of_first("");
}

std::optional<Checkpoint> Together::wait_for_first(const std::string& scene_path) const {
    for (;;) {
        const std::string told = ranks_.of_first("");
        if (told.empty()) return std::nullopt;
        Checkpoint begun = unpacked(std::string_view(told).substr(1));
        if (told[0] == a_run) return begun;
        try {
            jostle::make_start(parse_scene(begun.scene, scene_path), begun.state.box, std::nullopt, {}, ranks_);
        } catch (const InputError&) {  // the first one says it
            return std::nullopt;
        } catch (const StoppedElsewhere&) {
            return std::nullopt;
        }
    }
}

void require_same_command(const Ranks& ranks, const RunOptions& options) {
    const bool same = ranks.all_have(checksum(options.command_line + '\n' + program_version + '\n' + program_commit));
    if (same || ranks.rank() > 0) return;
    throw InputError({.key = "ranks",
                      .value = std::to_string(ranks.count()),
                      .problem = "they were started with different commands, or different builds of jostle, and make "
                                 "one run together",
                      .suggestion = "Start all with the same words; runs that have nothing to do with each other need "
                                    "--alone"});
}
