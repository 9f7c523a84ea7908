#include "jostle/simulation/simulation.hpp"

#include <algorithm>
#include <iterator>

#include "jostle/error/input_error.hpp"
#include "jostle/motion/springs.hpp"
#include "jostle/rods/space_filling_order.hpp"

namespace jostle {

Simulation::Simulation(State state, std::unique_ptr<Mobility> mobility, std::vector<std::unique_ptr<Motion>> motions,
                       const SimulationSettings& settings)
    : state_(std::move(state)),
      mobility_(std::move(mobility)),
      motions_(std::move(motions)),
      scheduled_motions_(motions_.size()),
      settings_(settings) {
    if (!(settings_.time_step > 0.0))
        throw InputError({.key = "time.step",
                          .value = std::to_string(settings_.time_step),
                          .problem = "the time step must be positive"});
    require_sound_springs(state_.springs);
    if (!settings_.growth) return;
    if (!state_.springs.empty())
        throw InputError({.key = "springs.file",
                          .problem = "springs hold rods that stay, and cells divide and die",
                          .suggestion = "Remove [springs] or [growth]"});
    growth_.emplace(*settings_.growth, settings_.seed);
    if (state_.rods.cycle.empty()) growth_->found(state_.rods);
}

bool Simulation::keeps_equilibrium() const {
    return settings_.kT > 0.0 && !settings_.growth &&
           std::all_of(motions_.begin(), motions_.end(),
                       [](const auto& motion) { return motion->keeps_equilibrium(); });
}

void Simulation::reorder(std::span<const std::uint32_t> order) {
    rows_change();
    state_.rods = reordered(state_.rods, order);
}

/// Takes over what the schedule has in this step. Returns the edges of the box at its end, if it changes.
std::optional<Vec3> Simulation::follow_schedule() {
    if (!settings_.schedule) return std::nullopt;
    Conditions now = settings_.schedule(state_.clock);
    sizes_changed_ = sizes_changed_ || now.kT != settings_.kT;
    settings_.kT = now.kT;
    const auto begin = motions_.begin();
    motions_.erase(begin, begin + static_cast<std::ptrdiff_t>(scheduled_motions_));
    scheduled_motions_ = now.motions.size();
    motions_.insert(motions_.begin(), std::make_move_iterator(now.motions.begin()),
                    std::make_move_iterator(now.motions.end()));
    if (now.edges && *now.edges == state_.box.edges()) return std::nullopt;
    return now.edges;
}

/// Now and then: rods near each other in space come near each other in memory.
void Simulation::renumber() {
    constexpr std::uint64_t every = 512;
    if (reordered_ && state_.clock.step % every != 0) return;
    reorder(space_filling_order(state_.rods, state_.box));
    reordered_ = true;
}

/// Forgets what belongs to rows, but for the contacts of the last step.
void Simulation::rows_change() {
    if (ids_before_.empty()) ids_before_ = state_.rods.id;
    search_.invalidate();
    sizes_changed_ = true;
}

}  // namespace jostle
