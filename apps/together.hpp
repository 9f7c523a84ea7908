#pragma once

#include <optional>
#include <string>
#include <vector>

#include "jostle/measurement/step_sums.hpp"
#include "jostle/parallel/ranks.hpp"
#include "jostle/run_files/checkpoint.hpp"
#include "jostle/simulation/simulation.hpp"
#include "run_options.hpp"
#include "run_scene.hpp"

/// The processes that make a run, or the only one, and how they begin together: the first reads the scene, makes the
/// start or reads the checkpoint, and opens the files; then it tells the others, which have been waiting.
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
    /// For the first: the others begin, too.
    void begin(const RunScene& scene, const jostle::Simulation& simulation, const jostle::StepSums& sums);
    bool have_begun() const { return have_begun_; }
    /// For the first, instead: there is nothing to be done.
    void call_off() const;
    /// For the others: the text of the scene, the state and the sums to begin with; none if there is nothing to be
    /// done.
    std::optional<jostle::Checkpoint> wait_for_first() const;

private:
    jostle::Ranks ranks_;
    std::vector<std::string> hosts_;
    bool have_begun_ = false;
};

/// Refuses ranks that were started with different words, or are different builds: they would not make one run. For the
/// first; the others only take part in it. Errors: InputError.
void require_same_command(const jostle::Ranks& ranks, const RunOptions& options);
