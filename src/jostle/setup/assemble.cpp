#include "jostle/setup/assemble.hpp"

#include <cmath>

#include "jostle/error/input_error.hpp"
#include "jostle/mobility/drag.hpp"
#include "jostle/scene/pressure_control.hpp"
#include "jostle/scene/rod_size.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/schedule.hpp"
#include "jostle/scene/step_limits.hpp"
#include "jostle/scene/time_step.hpp"

namespace jostle {

namespace {

/// Where noise moves even spheres less in a step than cells grow, contact forces hardly change from step to step, and
/// may become large. A function of the scene alone, so that a run goes on as it began.
bool noise_is_weak(const Scene& scene, double time_step) {
    const RodMobility sphere = capsule_drag(0.0, scene.rods.diameter, scene.fluid.viscosity);
    return std::sqrt(2.0 * thermal_energy(scene) * sphere.parallel * time_step) <= scene.growth.rate * time_step;
}

/// The scene as it is in one step.
Scene scene_of_step(const Scene& scene, std::uint64_t step, double time_step) {
    return scene_during(scene, static_cast<double>(step) * time_step, static_cast<double>(step + 1) * time_step);
}

/// What the schedule of a scene sets.
Schedule schedule_of(const Scene& scene, const Rods& rods, double time_step) {
    if (!has_schedule(scene)) return {};
    std::optional<Vec3> first;
    if (squeezes_box(scene)) first = box_edges(scene, total_volume(rods, dimensions_of(scene)));
    return [scene, time_step, first,
            ramp = ramp_of_edges(scene, total_volume(rods, dimensions_of(scene)))](const Clock& clock) {
        const Scene now = scene_of_step(scene, clock.step, time_step);
        Conditions conditions{thermal_energy(now), motions_of(now), std::nullopt};
        if (first) conditions.edges = value_at(*first, ramp, static_cast<double>(clock.step + 1) * time_step);
        return conditions;
    };
}

/// What keeps the rods at the pressure of the scene.
PressureControl control_of(const Scene& scene, const Rods& rods, double kT) {
    using Moves = PressureControl::Moves;
    const int piston = piston_direction(scene);
    const double edge = box_edges(scene, total_volume(rods, dimensions_of(scene)))[piston];
    const double count = static_cast<double>(rods.size()), time = pressure_relaxation_time(scene, count, edge);
    const bool plane = is_piston(scene);
    const bool each = scene.pressure.coupling == StrainCoupling::orthogonal;
    PressureControl control = {*scene.pressure.external,
                               plane  ? Moves::plane
                               : each ? Moves::edges
                                      : Moves::volume,
                               piston};
    if (kT > 0.0) control.mobility = (plane ? edge * edge : 1.0) / (time * count * kT);
    if (!plane) control.largest_move = largest_box_move(scene, rods);
    control.rate = (plane ? edge : 1.0) / time;
    return control;
}

/// kT of the last step that was made, or of the first.
double present_kT(const Scene& scene, const Clock& clock, double time_step) {
    const std::uint64_t last = clock.step > 0 ? clock.step - 1 : 0;
    return thermal_energy(has_schedule(scene) ? scene_of_step(scene, last, time_step) : scene);
}

}  // namespace

std::optional<StressField> make_field(const Scene& scene, const Box& box) {
    if (scene.output.field_every == 0) return std::nullopt;
    const double longest = grows(scene) ? scene.growth.division_length : scene.rods.length;
    return StressField(box, scene.output.field_spacing.value_or(longest + scene.rods.diameter));
}

void require_drawn_speeds(const Scene& scene, const Rods& rods) {
    if (rods.speed.empty() || scene.schedule.self_propulsion.empty()) return;
    throw InputError(
        {.key = "schedule.self_propulsion",
         .problem = "changes the mean speed, and the rods have speeds of their own, as a column speed gives them",
         .suggestion = "Remove the key, or the column speed"});
}

Simulation assemble(const Scene& scene, State state) {
    if (state.springs.empty() && !scene.springs.file.empty())
        throw InputError({.key = "springs.file", .value = scene.springs.file, .problem = "the springs were not read"});
    auto model = make_mobility(scene);
    const Box& box = state.box;
    const Rods& rods = state.rods;
    require_drawn_speeds(scene, rods);
    const std::vector<Spring>& springs = state.springs;
    const double step = time_step(scene, *model, box, rods, springs);
    require_short_step(growth_limits(scene, smallest_diameter(scene, rods)), step);
    if (!springs.empty()) {
        const StepLimit limit = spring_limit(scene, springs, rods, *model->at(rods, box));
        require_short_step({&limit, 1}, step);
    }
    SimulationSettings settings;
    settings.seed = scene.seed;
    settings.kT = present_kT(scene, state.clock, step);
    settings.time_step = step;
    settings.schedule = schedule_of(scene, rods, step);
    if (scene.pressure.external) {
        settings.pressure = control_of(scene, rods, settings.kT);
        if (settings.kT > 0.0)
            settings.pressure->least_edge =
                least_edge_between_images(rods, *model->at(rods, box), settings.kT, settings.time_step);
    }
    settings.brownian_correction = scene.contact.brownian_correction;
    settings.range = scene.contact.range.value_or(0.0);
    if (scene.contact.model == ContactModel::wca) {
        settings.brownian_correction = false;
        settings.wca_energy = scene.contact.energy.value_or(scene.fluid.kT);
    }
    settings.stress_conventions = scene.output.stress_conventions;
    settings.collision_moments = scene.output.stress_per_rod || scene.output.field_every > 0;
    settings.method = scene.solver.method;
    if (scene.contact.model == ContactModel::hard) {
        const bool weak = noise_is_weak(scene, settings.time_step);
        settings.relinearise = weak && !scene.pressure.external;  // about a box that forces have not opened yet
        settings.warm_start =
            scene.solver.warm_start == WarmStarts::automatic ? weak : scene.solver.warm_start == WarmStarts::always;
    }
    const bool paper = scene.solver.residual == ResidualKind::paper;
    settings.lcp.residual = paper ? LcpResidual::paper : LcpResidual::length;
    settings.lcp.tolerance = paper ? scene.solver.tolerance : scene.solver.tolerance * scene.rods.diameter;
    settings.lcp.max_iterations = scene.solver.max_iterations;
    settings.lcp.step_rule = scene.solver.step_rule == StepRule::bb1   ? BarzilaiBorwein::bb1
                             : scene.solver.step_rule == StepRule::bb2 ? BarzilaiBorwein::bb2
                                                                       : BarzilaiBorwein::alternating;
    if (has_flow(scene)) settings.flow = flow_of(scene);
    if (grows(scene)) settings.growth = scene.growth;
    return Simulation(std::move(state), std::move(model), motions_of(scene), settings);
}

}  // namespace jostle
