#pragma once

#include <optional>
#include <string>
#include <vector>

#include "jostle/measurement/step_sums.hpp"
#include "jostle/parallel/ranks.hpp"
#include "jostle/run_files/checkpoint.hpp"
#include "jostle/setup/anneal.hpp"
#include "jostle/simulation/simulation.hpp"
#include "run_options.hpp"
#include "run_scene.hpp"

/// The processes that make a run, or the only one, and how they begin together: the first reads the scene, or the
/// checkpoint, has the others make a random start with it, and opens the files; then it tells the others, which have
/// been waiting, what the run begins with.
class Together {
public:
    /// One process alone.
    Together() = default;
    /// All ranks call it together.
    explicit Together(const jostle::Ranks& ranks);

    const jostle::Ranks& ranks() const { return ranks_; }
    bool is_first() const { return ranks_.rank() == 0; }
    /// Names of their machines, each once.
    const std::vector<std::string>& hosts() const { return hosts_; }

    /// For the first: refuses what several ranks cannot do, as far as the scene tells. Errors: InputError.
    void require_ready(const jostle::Scene& scene) const;
    /// For the first: the rods of a start; random ones are made by all. Errors: as `jostle::make_start`.
    jostle::Rods make_start(const RunScene& scene, const jostle::Box& box, const std::optional<jostle::Rods>& from_file,
                            const jostle::AnnealingWatch& watch);
    /// For the first: the others begin, too.
    void begin(const RunScene& scene, const jostle::Simulation& simulation, const jostle::StepSums& sums);
    /// For the first: what the others do.
    enum class Others {
        wait,   ///< to be told
        work,   ///< at the same as the first
        leave,  ///< as the first does: they have met the same
    };
    Others others() const { return others_; }
    /// For the first, if the others wait: there is nothing to be done.
    void call_off() const;
    /// For the others: makes starts with the first, and waits for the text of the scene, the state and the sums to
    /// begin with; none if there is nothing to be done. `scene_path`: of the scene, for messages.
    std::optional<jostle::Checkpoint> wait_for_first(const std::string& scene_path) const;

private:
    jostle::Ranks ranks_;
    std::vector<std::string> hosts_;
    Others others_ = Others::wait;
};

/// Refuses ranks that were started with different words, or are different builds: they would not make one run. For the
/// first; the others only take part in it. Errors: InputError.
void require_same_command(const jostle::Ranks& ranks, const RunOptions& options);
