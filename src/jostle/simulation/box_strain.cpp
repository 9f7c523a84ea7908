#include "jostle/simulation/box_strain.hpp"

#include <array>
#include <cmath>

#include "jostle/math/random.hpp"

namespace jostle {

namespace {

using Moves = PressureControl::Moves;

std::array<double, 3> noise_of_the_box(const StepContext& context) {
    constexpr std::array<std::uint64_t, 1> of_the_box = {0};
    std::array<Normals, 1> normal;
    fill_normals({context.seed, context.step, Stream::box, 0}, of_the_box, normal);
    return {normal[0][0], normal[0][1], normal[0][2]};
}

/// That of the upper plane across a direction.
Wall piston_of(const Box& box, int direction) {
    for (const Wall& wall : walls_of(box))
        if (wall.number == 2 * static_cast<std::uint32_t>(direction) + 1) return wall;
    return {};
}

/// Theory, eq. (10.3): contact forces come in the same step.
EdgesUnderPressure piston_moved(const State& state, const PressureControl& control, double kT,
                                const StepContext& context) {
    const Wall piston = piston_of(state.box, control.piston);
    const double drift = -control.mobility * control.external * area_of(piston, state.box) * context.time_step;
    const double noise = std::sqrt(2.0 * kT * control.mobility * context.time_step) * noise_of_the_box(context)[0];
    EdgesUnderPressure moved{state.box.edges()};
    moved.edges[control.piston] += drift + noise;
    moved.piston = {piston.body(), drift + noise, drift};
    return moved;
}

/// Theory, eq. (10.1).
EdgesUnderPressure moved_by_forces(const State& state, std::size_t rods, const PressureControl& control, double kT,
                                   const StepContext& context) {
    EdgesUnderPressure moved{state.box.edges()};
    if (!state.box_force) return moved;
    Vec3& edges = moved.edges;
    const Vec3& force = *state.box_force;
    const std::array<double, 3> normal = noise_of_the_box(context);
    const double noise = std::sqrt(2.0 * kT * control.mobility * context.time_step);
    const auto move_by = [&](double net_force) {
        const double move = control.mobility * net_force * context.time_step;
        if (std::fabs(move) <= control.largest_move) return move;
        moved.held_back = true;
        return std::copysign(control.largest_move, move);
    };
    const bool each = control.moves == Moves::edges;
    const double mean = (force.x + force.y + force.z) / 3.0;
    const Vec3 virial = each ? force : Vec3{mean, mean, mean};
    const double free = (static_cast<double>(rods) + 1.0) * kT - control.external * state.box.volume();
    for (int k = 0; k < 3; ++k) {
        const auto own = static_cast<std::size_t>(each ? k : 0);
        const double strain = move_by(free + virial[k]) + noise * normal[own];
        edges[k] *= std::exp(each ? strain : strain / 3.0);
    }
    return moved;
}

}  // namespace

EdgesUnderPressure edges_under_pressure(const State& state, std::size_t rods, const PressureControl& control, double kT,
                                        const StepContext& context) {
    if (kT > 0.0)
        return control.moves == Moves::plane ? piston_moved(state, control, kT, context)
                                             : moved_by_forces(state, rods, control, kT, context);
    return {opened(state.box.edges(), control, -control.rate, context.time_step)};
}

Vec3 force_on_box(const StepReport& report) {
    Vec3 force;
    for (int k = 0; k < 3; ++k) force[k] = report.centre_of_mass_virial(k, k) + trace(report.spring_virial) / 3.0;
    return force;
}

BoxColumn opening_of(const Box& before, const PressureControl& control) {
    if (control.moves != Moves::plane) return {control.rate / (control.external * before.volume()), std::nullopt};
    const Wall piston = piston_of(before, control.piston);
    const bool thermal = control.mobility > 0.0;
    return {thermal ? control.mobility : control.rate / (control.external * area_of(piston, before)), piston.body()};
}

Vec3 opened(const Vec3& edges, const PressureControl& control, double rate, double time_step) {
    if (control.moves != Moves::plane) return std::exp(rate * time_step / 3.0) * edges;
    Vec3 moved = edges;
    moved[control.piston] += rate * time_step;
    return moved;
}

}  // namespace jostle
