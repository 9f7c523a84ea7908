#include "jostle/simulation/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "jostle/error/input_error.hpp"
#include "jostle/motion/springs.hpp"
#include "jostle/rods/space_filling_order.hpp"

namespace jostle {

namespace {

/// Refuses a box that is not sheared as the flow has it at the time of the clock: rods would be thrown onto others.
void require_sheared(const State& state, const std::optional<ShearFlow>& flow) {
    if (!flow) return;
    const Box& box = state.box;
    const double strain = flow->strain_at(state.clock.time), edge = box.edges().x;
    const double off = std::remainder(strain * box.edges().y - box.offset(), edge);
    if (box.periodic()[0] && box.periodic()[1] && std::fabs(off) <= 1e-6 * edge) return;
    throw InputError({.key = "box",
                      .value = std::to_string(box.offset()),
                      .problem = "is not sheared as the flow has it: the strain is " + std::to_string(strain),
                      .allowed = "a box that is periodic along x and y, its copies above along y displaced by the "
                                 "strain times its edge along y",
                      .suggestion = "Give box.sheared(strain * edges.y)"});
}

}  // namespace

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
    previous_forces_in_all_ = counted_forces_ = state_.previous_forces.size();
    settings_.has_springs = !state_.springs.empty();
    require_sound_springs(state_.springs);
    require_sheared(state_, settings_.flow);
    if (!settings_.growth) return;
    if (!state_.springs.empty())
        throw InputError({.key = "springs.file",
                          .problem = "springs hold rods that stay, and cells divide and die",
                          .suggestion = "Remove [springs] or [growth]"});
    growth_.emplace(*settings_.growth, settings_.seed);
    if (state_.rods.cycle.empty()) growth_->found(state_.rods);
}

bool Simulation::keeps_equilibrium() const {
    const bool flows = settings_.flow && (settings_.flow->rate != 0.0 || settings_.flow->amplitude != 0.0);
    return settings_.kT > 0.0 && !settings_.growth && !flows &&
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

/// The edges of the box at the end of the step, if it changes.
std::optional<Vec3> Simulation::edges_of_step(StepReport& report) {
    std::optional<Vec3> edges = follow_schedule();
    if (!settings_.pressure) return edges;
    const EdgesUnderPressure moved =
        edges_under_pressure(state_, rods_in_all(), *settings_.pressure, settings_.kT, context());
    report.box_held_back = moved.held_back;
    known_.piston = moved.piston;
    const Vec3& edge = moved.edges;
    if (settings_.pressure->moves != PressureControl::Moves::plane)
        report.lacking_edge = std::max(0.0, settings_.pressure->least_edge - std::min({edge.x, edge.y, edge.z}));
    return moved.edges;
}

/// Now and then: rods near each other in space come near each other in memory.
void Simulation::renumber() {
    constexpr std::uint64_t every = 512;
    if (domain_.is_shared()) return;  // wherever rods are gathered
    if (reordered_ && state_.clock.step % every != 0) return;
    reorder(space_filling_order(state_.rods, state_.box));
    reordered_ = true;
}

/// Forgets what belongs to rows, but for the contacts of the last step.
void Simulation::rows_change() {
    if (ids_before_.empty()) ids_before_ = state_.rods.id;
    searches_.rods.invalidate();
    sizes_changed_ = true;
}

}  // namespace jostle
