#include "jostle/setup/assemble.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "jostle/error/input_error.hpp"
#include "jostle/mobility/drag.hpp"
#include "jostle/mobility/drag_mobility.hpp"
#include "jostle/motion/brownian_motion.hpp"
#include "jostle/motion/self_propulsion.hpp"
#include "jostle/scene/rod_size.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/step_limits.hpp"

namespace jostle {

namespace {

using DragOfViscosity = RodMobility (*)(double length, double diameter, double viscosity);

DragOfViscosity drag_of(MobilityModel model) {
    switch (model) {
        case MobilityModel::slender_body:
            return slender_body_drag;
        case MobilityModel::finite_aspect_ratio:
            return finite_aspect_ratio_drag;
        case MobilityModel::capsule:
            break;
    }
    return capsule_drag;
}

}  // namespace

std::unique_ptr<Mobility> make_mobility(const Scene& scene) {
    return std::make_unique<DragMobility>(
        [drag = drag_of(scene.mobility.model), viscosity = scene.fluid.viscosity](double length, double diameter) {
            return drag(length, diameter, viscosity);
        });
}

double time_step(const Scene& scene, const MobilityOperator& mobility, const Rods& rods) {
    const double thinnest = smallest_diameter(scene, rods);
    double step = 0.0;
    if (scene.time.step) {
        step = *scene.time.step;
    } else {
        const double length = *scene.time.rms_step * thinnest;
        step = length * length / (2.0 * fastest_diffusion(thermal_energy(scene), mobility, rods.size()));
    }
    require_short_growth(scene, thinnest, step);
    return step;
}

namespace {

void check_springs(const Scene& scene, const Rods& rods, const MobilityOperator& mobility,
                   std::span<const Spring> springs, double time_step) {
    if (springs.empty() && !scene.springs.file.empty())
        throw InputError({.key = "springs.file", .value = scene.springs.file, .problem = "the springs were not read"});
    std::unordered_map<std::uint64_t, std::size_t> rows;
    if (!springs.empty())
        for (std::size_t i = 0; i < rods.size(); ++i) rows[rods.id[i]] = i;
    const auto mobility_of = [&](std::uint64_t id) {
        const auto found = rows.find(id);
        return found == rows.end() ? RodMobility{} : mobility.of_rod(found->second);
    };
    require_slow_springs(scene, springs, mobility_of, time_step);
}

/// Where noise moves even spheres less in a step than cells grow, contact forces hardly change from step to step, and
/// may become large. A function of the scene alone, so that a run goes on as it began.
bool noise_is_weak(const Scene& scene, double time_step) {
    const RodMobility sphere = capsule_drag(0.0, scene.rods.diameter, scene.fluid.viscosity);
    return std::sqrt(2.0 * thermal_energy(scene) * sphere.parallel * time_step) <= scene.growth.rate * time_step;
}

}  // namespace

std::optional<StressField> make_field(const Scene& scene, const Box& box) {
    if (scene.output.field_every == 0) return std::nullopt;
    const double longest = scene.growth.rate > 0.0 ? scene.growth.division_length : scene.rods.length;
    return StressField(box, scene.output.field_spacing.value_or(longest + scene.rods.diameter));
}

Simulation assemble(const Scene& scene, State state) {
    auto model = make_mobility(scene);
    const auto mobility = model->at(state.rods, state.box);
    SimulationSettings settings;
    settings.seed = scene.seed;
    settings.kT = thermal_energy(scene);
    settings.time_step = time_step(scene, *mobility, state.rods);
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
        settings.relinearise = noise_is_weak(scene, settings.time_step);
        settings.warm_start = scene.solver.warm_start == WarmStarts::automatic
                                  ? settings.relinearise
                                  : scene.solver.warm_start == WarmStarts::always;
    }
    const bool paper = scene.solver.residual == ResidualKind::paper;
    settings.lcp.residual = paper ? LcpResidual::paper : LcpResidual::length;
    settings.lcp.tolerance = paper ? scene.solver.tolerance : scene.solver.tolerance * scene.rods.diameter;
    settings.lcp.max_iterations = scene.solver.max_iterations;
    settings.lcp.step_rule = scene.solver.step_rule == StepRule::bb1   ? BarzilaiBorwein::bb1
                             : scene.solver.step_rule == StepRule::bb2 ? BarzilaiBorwein::bb2
                                                                       : BarzilaiBorwein::alternating;
    if (scene.growth.rate > 0.0) settings.growth = scene.growth;
    check_springs(scene, state.rods, *mobility, state.springs, settings.time_step);
    std::vector<std::unique_ptr<Motion>> motions;
    if (settings.kT > 0.0) motions.push_back(std::make_unique<BrownianMotion>(settings.kT));
    if (scene.motion.self_propulsion != 0.0) motions.push_back(std::make_unique<SelfPropulsion>(swimming_of(scene)));
    return Simulation(std::move(state), std::move(model), std::move(motions), settings);
}

}  // namespace jostle
