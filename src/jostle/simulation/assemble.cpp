#include "jostle/simulation/assemble.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "jostle/error/input_error.hpp"
#include "jostle/mobility/drag.hpp"
#include "jostle/mobility/drag_mobility.hpp"
#include "jostle/motion/brownian_motion.hpp"
#include "jostle/motion/self_propulsion.hpp"
#include "jostle/simulation/validate_scene.hpp"

namespace jostle {

namespace {

/// Of the mean time between tumbles, with tumble_time = "auto": as bacteria do (Berg and Brown 1972).
constexpr double automatic_tumble_share = 0.1;
/// A tumble that turns the ends of a rod by more than this in a step (in D) could carry them through others.
constexpr double farthest_turn = 0.25;
/// A rod that swims farther than this in a step (in D) could pass through others.
constexpr double farthest_swim = 0.5;
/// Persistence times after which a free swimmer has forgotten where it swam: exp(-5) = 0.7 %.
constexpr double automatic_lag = 5.0;

[[noreturn]] void refuse_swimmers(const char* key, double value, std::string problem, std::string allowed) {
    throw InputError({.key = key,
                      .value = fmt::format("{:.4g}", value),
                      .problem = std::move(problem),
                      .allowed = std::move(allowed),
                      .suggestion = std::string("Use a shorter time.step or slower ") +
                                    (std::string_view(key).starts_with("motion.tumble") ? "tumbles" : "swimmers"),
                      .place = {}});
}

}  // namespace

std::unique_ptr<Mobility> make_mobility(const Scene& scene, const Rods& rods) {
    const bool slender = scene.mobility.model == MobilityModel::slender_body;
    const double viscosity = scene.fluid.viscosity;
    auto mobility = std::make_unique<DragMobility>([slender, viscosity](double length, double diameter) {
        return slender ? slender_body_drag(length, diameter, viscosity)
                       : finite_aspect_ratio_drag(length, diameter, viscosity);
    });
    mobility->update(rods);
    return mobility;
}

double thermal_energy(const Scene& scene) {
    return scene.motion.brownian ? scene.fluid.kT : 0.0;
}

double fastest_diffusion(double kT, const Mobility& mobility, std::size_t rod_count) {
    double fastest = 0.0;
    for (std::size_t i = 0; i < rod_count; ++i) {
        const RodMobility rod = mobility.of_rod(i);
        fastest = std::max(fastest, kT * (rod.parallel + 2.0 * rod.perpendicular) / 3.0);
    }
    return fastest;
}

double time_step(const Scene& scene, const Mobility& mobility, const Rods& rods) {
    double step = 0.0;
    if (scene.time.step) {
        step = *scene.time.step;
    } else {
        const double length = *scene.time.rms_step * *std::min_element(rods.diameter.begin(), rods.diameter.end());
        step = length * length / (2.0 * fastest_diffusion(thermal_energy(scene), mobility, rods.size()));
    }
    require_short_growth(scene, step);
    return step;
}

Swimming swimming_of(const Scene& scene) {
    const Scene::MotionTable& motion = scene.motion;
    Swimming swimming = {motion.self_propulsion, motion.self_propulsion_deviation, motion.tumble_rate, 0.0,
                         motion.reversal_rate};
    if (motion.tumble_rate > 0.0)
        swimming.tumble_time = motion.tumble_time.value_or(automatic_tumble_share / motion.tumble_rate);
    return swimming;
}

void require_slow_swimmers(const Scene& scene, const Rods& rods, double time_step) {
    const Swimming swimming = swimming_of(scene);
    if (swimming.speed == 0.0) return;
    const std::vector<double> speed = SelfPropulsion(swimming).speeds(rods, scene.seed);
    for (std::size_t i = 0; i < rods.size(); ++i) {
        const double most = farthest_swim * rods.diameter[i] / time_step;
        if (std::fabs(speed[i]) > most)
            refuse_swimmers("motion.self_propulsion", speed[i],
                            fmt::format("takes a rod through others in a single step of {:.4g}", time_step),
                            fmt::format("speeds up to {:.4g}, half a diameter in a step", most));
    }
    if (swimming.tumble_rate == 0.0) return;
    if (swimming.tumble_rate * time_step > 1.0)
        refuse_swimmers("motion.tumble_rate", swimming.tumble_rate, "is more than one tumble in a time step",
                        fmt::format("at most {:.4g}", 1.0 / time_step));
    const double grown = scene.growth.rate > 0.0 ? scene.growth.division_length : 0.0;
    const auto steps = static_cast<double>(Tumbles(swimming.tumble_rate, swimming.tumble_time).steps(time_step));
    for (std::size_t i = 0; i < rods.size(); ++i) {
        const double longest = std::max(rods.length[i], grown);
        const double fewest = std::numbers::pi * 0.5 * longest / (farthest_turn * rods.diameter[i]);
        if (steps < fewest)
            refuse_swimmers("motion.tumble_time", swimming.tumble_time,
                            "is too short: the ends of a rod would pass through others in a single step",
                            fmt::format("at least {:.4g}", std::ceil(fewest) * time_step));
    }
}

double persistence_time(const Scene& scene, const Mobility& mobility, std::size_t rod_count) {
    const double kT = thermal_energy(scene);
    const double turns = scene.motion.tumble_rate + 2.0 * scene.motion.reversal_rate;
    double longest = 0.0;
    for (std::size_t i = 0; i < rod_count; ++i)
        longest = std::max(longest, 1.0 / (2.0 * kT * mobility.of_rod(i).rotational + turns));
    return longest;
}

double active_stress_lag(const Scene& scene, const Mobility& mobility, std::size_t rod_count) {
    if (scene.output.active_stress_lag) return *scene.output.active_stress_lag;
    const double persistence = persistence_time(scene, mobility, rod_count);
    return std::isfinite(persistence) ? automatic_lag * persistence : 0.1 * scene.time.production;
}

namespace {

/// Ids at the start are 0 ... count - 1, or what a file holds.
constexpr int founder_bits_of_file = 31;

void set_springs(const Scene& scene, const Rods& rods, const Mobility& mobility, std::vector<Spring> springs,
                 SimulationSettings& settings) {
    if (springs.empty() && !scene.springs.file.empty())
        throw InputError({.key = "springs.file", .value = scene.springs.file, .problem = "the springs were not read"});
    std::unordered_map<std::uint64_t, std::size_t> rows;
    if (!springs.empty())
        for (std::size_t i = 0; i < rods.size(); ++i) rows[rods.id[i]] = i;
    const auto mobility_of = [&](std::uint64_t id) {
        const auto found = rows.find(id);
        return found == rows.end() ? RodMobility{} : mobility.of_rod(found->second);
    };
    require_slow_springs(scene, spring_relaxation(springs, mobility_of, settings.time_step), settings.time_step);
    settings.springs = std::move(springs);
}

/// Where noise moves even spheres less in a step than cells grow, contact forces hardly change from step to step, and
/// may become large. A function of the scene alone, so that a run goes on as it began.
bool noise_is_weak(const Scene& scene, double time_step) {
    const RodMobility sphere = finite_aspect_ratio_drag(0.0, scene.rods.diameter, scene.fluid.viscosity);
    return std::sqrt(2.0 * thermal_energy(scene) * sphere.parallel * time_step) <= scene.growth.rate * time_step;
}

void set_growth(const Scene& scene, SimulationSettings& settings) {
    settings.growth = scene.growth;
    settings.founder_bits = scene.rods.start == StartKind::file
                                ? founder_bits_of_file
                                : static_cast<int>(std::bit_width(scene.rods.count - 1));
}

}  // namespace

std::optional<StressField> make_field(const Scene& scene, const Box& box) {
    if (scene.output.field_every == 0) return std::nullopt;
    const double longest = scene.growth.rate > 0.0 ? scene.growth.division_length : scene.rods.length;
    return StressField(box, scene.output.field_spacing.value_or(longest + scene.rods.diameter));
}

void require_slow_springs(const Scene& scene, double relaxation, double time_step) {
    if (relaxation <= 1.0) return;
    throw InputError({.key = "springs.file",
                      .value = scene.springs.file,
                      .problem = fmt::format("springs are too stiff for the time step: in one of {:.4g} they may lose "
                                             "{:.4g} times their stretch (2 dt times stiffness times mobility)",
                                             time_step, relaxation),
                      .allowed = fmt::format("at most 1, with a step of at most {:.4g}", time_step / relaxation),
                      .suggestion = "Use a shorter time.step or softer springs"});
}

Simulation assemble(const Scene& scene, const Box& box, Rods rods, Clock clock, std::vector<Spring> springs,
                    std::vector<LastForce> last_forces) {
    auto mobility = make_mobility(scene, rods);
    SimulationSettings settings;
    settings.seed = scene.seed;
    settings.kT = thermal_energy(scene);
    settings.time_step = time_step(scene, *mobility, rods);
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
        settings.look_again = noise_is_weak(scene, settings.time_step);
        settings.warm_start = scene.solver.warm_start == WarmStarts::automatic
                                  ? settings.look_again
                                  : scene.solver.warm_start == WarmStarts::always;
    }
    const bool paper = scene.solver.residual == ResidualKind::paper;
    settings.lcp.residual = paper ? LcpResidual::paper : LcpResidual::length;
    settings.lcp.tolerance = paper ? scene.solver.tolerance : scene.solver.tolerance * scene.rods.diameter;
    settings.lcp.max_iterations = scene.solver.max_iterations;
    settings.lcp.step_rule = scene.solver.step_rule == StepRule::bb1   ? BarzilaiBorwein::bb1
                             : scene.solver.step_rule == StepRule::bb2 ? BarzilaiBorwein::bb2
                                                                       : BarzilaiBorwein::alternating;
    if (scene.growth.rate > 0.0) set_growth(scene, settings);
    set_springs(scene, rods, *mobility, std::move(springs), settings);
    std::vector<std::unique_ptr<Motion>> motions;
    if (settings.kT > 0.0) motions.push_back(std::make_unique<BrownianMotion>(settings.kT, *mobility));
    if (scene.motion.self_propulsion != 0.0) motions.push_back(std::make_unique<SelfPropulsion>(swimming_of(scene)));
    return Simulation(box, std::move(rods), clock, std::move(mobility), std::move(motions), settings,
                      std::move(last_forces));
}

}  // namespace jostle
