#include "jostle/scene/step_limits.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "jostle/contact/own_image.hpp"
#include "jostle/contact/wca_forces.hpp"
#include "jostle/error/refuse.hpp"
#include "jostle/scene/number_text.hpp"
#include "jostle/scene/pressure_control.hpp"
#include "jostle/scene/rod_size.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/schedule.hpp"

namespace jostle {

namespace {

/// Rates and speeds of cells beyond the mean by so many standard deviations are one in thirty thousand.
constexpr double deviations_of_the_fastest = 4.0;
/// Of D: overlaps in a colony are some 1.6 times what the fastest cells lengthen in a step.
constexpr double automatic_growth = 0.01, advised_growth = 0.03, largest_growth = 0.1;
/// Cells divide late by as much of what they add from birth to division, at most, for being looked at now and then.
constexpr double advised_lateness = 0.2, latest_division = 0.25;
/// Of their stretch, that springs lose: thermal modes are too wide by half of it.
constexpr double automatic_relaxation = 0.05, advised_relaxation = 0.1, largest_relaxation = 1.0;
/// Of the overlap of rods that meet with `high_energy`.
constexpr double automatic_throw = 1.0, advised_throw = 1.5, largest_throw = 2.0;
/// In D, by which rods that touch are brought nearer: as what cells lengthen by, it is a gap that contacts open again.
constexpr double automatic_squeeze = 0.01, advised_squeeze = 0.03, largest_squeeze = 0.1;
/// Of one step, by which the flow shears the box.
constexpr double automatic_strain = 0.01, advised_strain = 0.02, largest_strain = 0.1;
/// Of the root mean square step of noise, by which the flow takes rods that touch.
constexpr double advised_flow_to_noise = 0.5, largest_flow_to_noise = 2.5;
/// In kT: the energy with which one pair in 150 meets.
constexpr double high_energy = 5.0;
/// Of the angle by which its own images let a rod be inclined.
constexpr double automatic_turn = 0.5, largest_turn = 1.0;
/// Of the free room between opposite walls, that noise moves the end of a rod by in a step.
constexpr double automatic_step_between_walls = 0.2, largest_step_between_walls = 1.0 / 3.0;

void append(std::vector<StepLimit>& limits, std::vector<StepLimit> more) {
    limits.insert(limits.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

std::vector<StepLimit> motion_limits(const Scene& scene, const Mobility& model, const Box& box, const Rods& rods) {
    std::vector<StepLimit> limits;
    const auto mobility = model.at(rods, box);
    for (const auto& motion : motions_of(scene_at_its_hardest(scene)))
        append(limits, motion->step_limits(rods, *mobility, scene.seed));
    return limits;
}

/// The shortest and the longest of the cells that are to come, as fast as they get.
Rods cells_to_come(const Scene& scene, double diameter) {
    const double fastest = std::fabs(scene_at_its_hardest(scene).motion.self_propulsion) +
                           deviations_of_the_fastest * scene.motion.self_propulsion_deviation;
    Rods cells;
    cells.push_back(0, {}, {1, 0, 0}, std::max(0.0, 0.5 * (scene.growth.division_length - diameter)), diameter);
    cells.push_back(1, {}, {1, 0, 0}, scene.growth.division_length, diameter);
    cells.speed.assign(2, fastest);
    return cells;
}

}  // namespace

std::vector<StepLimit> growth_limits(const Scene& scene, double diameter) {
    const GrowthLaw& growth = scene.growth;
    if (!grows(scene)) return {};
    const double fastest = (1.0 + deviations_of_the_fastest * growth.rate_deviation) * growth.rate;
    std::vector<StepLimit> limits = {{.key = "growth.rate",
                                      .value = rounded(growth.rate),
                                      .number = growth.rate,
                                      .harm = "lengthens cells so far that contacts cannot follow",
                                      .what = "the fastest cells lengthen by",
                                      .unit = "D",
                                      .remedy = "",
                                      .rate = fastest,
                                      .scale = diameter,
                                      .automatic = automatic_growth,
                                      .advised = advised_growth,
                                      .largest = largest_growth}};
    if (growth.division_every > 1)
        limits.push_back(
            {.key = "growth.division_every",
             .value = fmt::format("{}", growth.division_every),
             .number = static_cast<double>(growth.division_every),
             .harm = "lets cells divide late",
             .what = "the part that cells add between two looks, of what they add from birth to division, is",
             .unit = "",
             .remedy = "look more often",
             .rate = fastest * static_cast<double>(growth.division_every),
             .scale = 0.5 * (growth.division_length + diameter),
             .automatic = advised_lateness,
             .advised = latest_division,
             .largest = latest_division});
    return limits;
}

namespace {

/// Of rods that turn, between their own periodic images, by more than these let them be inclined, it could not be told
/// what holds them.
std::vector<StepLimit> image_limits(const Scene& scene, const Box& box, const Rods& rods,
                                    const MobilityOperator& mobility) {
    if (scene.contact.model != ContactModel::hard || thermal_energy(scene) == 0.0) return {};
    StepLimit limit = {.key = "box.edges",
                       .value = text(box.edges()),
                       .harm = "leaves rods no room to turn between their own images",
                       .what = "the turn of a rod, over that which its images leave room for, is",
                       .unit = "",
                       .remedy = "a larger box",
                       .diffusive = true,
                       .automatic = automatic_turn,
                       .advised = largest_turn,
                       .largest = largest_turn};
    for (std::size_t i = 0; i < rods.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const double edge = box.edges()[static_cast<int>(k)];
            if (rods.length[i] == 0.0 || !box.periodic()[k] || edge >= rods.length[i] + rods.diameter[i]) continue;
            const double room = inclination_between_images(edge, rods.length[i], rods.diameter[i]);
            limit.rate =
                std::max(limit.rate, 2.0 * thermal_energy(scene) * mobility.of_rod(i).rotational / (room * room));
        }
    if (limit.rate == 0.0) return {};
    return {limit};
}

}  // namespace

double least_edge_between_images(const Rods& rods, const MobilityOperator& mobility, double kT, double time_step) {
    double least = 0.0;
    for (std::size_t i = 0; i < rods.size(); ++i) {
        const double turn = std::sqrt(2.0 * kT * mobility.of_rod(i).rotational * time_step) / largest_turn;
        least = std::max(least, distance_between_images(turn, rods.length[i], rods.diameter[i]));
    }
    return least;
}

namespace {

/// How fast the box brings rods together that touch, end to end, or a plane comes towards them, as its schedule has it
/// at the fastest.
std::vector<StepLimit> squeeze_limits(const Scene& scene, const Rods& rods) {
    const double volume = volume_of_all(scene, rods);
    RampPoint<Vec3> from{0.0, box_edges(scene, volume)};
    double strain_rate = 0.0, slenderest = 0.0, of_planes = 0.0;
    for (const RampPoint<Vec3>& to : ramp_of_edges(scene, volume)) {
        for (int k = 0; k < dimensions_of(to.value); ++k) {
            const double rate = (from.value[k] - to.value[k]) / (to.time - from.time);
            double& fastest = scene.walls.faces[static_cast<std::size_t>(k)] ? of_planes : strain_rate;
            fastest = std::max(fastest, &fastest == &of_planes ? rate : rate / to.value[k]);
        }
        from = to;
    }
    for (std::size_t i = 0; i < rods.size(); ++i)
        slenderest = std::max(slenderest, (rods.length[i] + rods.diameter[i]) / rods.diameter[i]);
    const double rate = std::max(strain_rate * slenderest, of_planes / smallest_diameter(scene, rods));
    if (rate == 0.0) return {};
    return {{.key = key_of_box_ramp(scene),
             .value = "",
             .harm = "closes gaps so far that contacts cannot follow",
             .what = "the box, or a plane, brings what touches nearer by",
             .unit = "D",
             .remedy = "a slower ramp",
             .rate = rate,
             .automatic = automatic_squeeze,
             .advised = advised_squeeze,
             .largest = largest_squeeze}};
}

/// The flow takes rods that touch apart, or together, by up to the strain times their length; and turns them.
std::vector<StepLimit> flow_limits(const Scene& scene, const Rods& rods, const MobilityOperator& mobility) {
    if (!flows(scene)) return {};
    const ShearFlow flow = flow_of(scene);
    const bool steady = flow.rate != 0.0;
    const double rate = std::fabs(flow.rate) + flow.amplitude * flow.angular_frequency;
    StepLimit strain = {.key = steady ? "flow.shear_rate" : "flow.strain_amplitude",
                        .value = text(steady ? flow.rate : flow.amplitude),
                        .number = std::fabs(steady ? flow.rate : flow.amplitude),
                        .harm = "turns rods too far in a step",
                        .what = "the strain of a step is up to",
                        .unit = "",
                        .remedy = "a slower flow",
                        .rate = rate,
                        .automatic = automatic_strain,
                        .advised = advised_strain,
                        .largest = largest_strain};
    StepLimit against_noise = strain, in_diameters = strain;
    const double kT = thermal_energy(scene);
    against_noise.number = 0.0;
    against_noise.rate = 0.0;
    against_noise.diffusive = true;
    against_noise.harm = "takes rods that touch too far";
    against_noise.what = "the flow takes the ends of rods that touch, over the rms step of noise, by up to";
    against_noise.automatic = against_noise.advised = advised_flow_to_noise;
    against_noise.largest = largest_flow_to_noise;
    in_diameters.rate = 0.0;
    in_diameters.harm = against_noise.harm;
    in_diameters.what = "the flow takes the ends of rods that touch by up to";
    in_diameters.unit = "D";
    in_diameters.automatic = automatic_squeeze;
    in_diameters.advised = advised_squeeze;
    in_diameters.largest = largest_squeeze;
    for (std::size_t i = 0; i < rods.size(); ++i) {
        const double way = rate * (rods.length[i] + rods.diameter[i]);
        const RodMobility rod = mobility.of_rod(i);
        const double diffusion = kT * (rod.parallel + 2.0 * rod.perpendicular) / 3.0;
        if (kT > 0.0) against_noise.rate = std::max(against_noise.rate, way * way / (2.0 * diffusion));
        in_diameters.rate = std::max(in_diameters.rate, way / rods.diameter[i]);
    }
    return {strain, kT > 0.0 ? against_noise : in_diameters};
}

/// The narrowest that a schedule makes the box, edge by edge. Under a bath the box of the start, so that a run goes on
/// at the step that it began with.
Box narrowest(const Scene& scene, const Box& box, const Rods& rods) {
    if (scene.pressure.external) return box.with_edges(box_edges(scene, volume_of_all(scene, rods)));
    if (!squeezes_box(scene)) return box;
    const double volume = volume_of_all(scene, rods);
    Vec3 edges = box_edges(scene, volume);
    for (const RampPoint<Vec3>& point : ramp_of_edges(scene, volume))
        for (int k = 0; k < 3; ++k) edges[k] = std::min(edges[k], point.value[k]);
    return {edges, box.periodic(), box.walls()};
}

/// Where noise moves the end of a rod along a wall farther in a step than a third of the room between opposite walls,
/// paths meet both in one step, and are mirrored at one (theory, section 6).
std::vector<StepLimit> wall_limits(const Scene& scene, const Box& box, const Rods& rods,
                                   const MobilityOperator& mobility) {
    const double kT = thermal_energy(scene);
    const bool mirrored = scene.contact.brownian_correction && scene.contact.model == ContactModel::hard;
    if (!box.walls().any() || !mirrored || kT == 0.0) return {};
    double narrowest = INFINITY;
    for (int k = 0; k < 3; ++k)
        if (!box.periodic()[static_cast<std::size_t>(k)] && k < box.dimensions())
            narrowest = std::min(narrowest, box.edges()[k]);
    StepLimit limit = {.key = scene.box.edges ? "box.edges" : fraction_key(scene),
                       .value = scene.box.edges ? text(box.edges()) : text(*given_fraction(scene)),
                       .harm = "leaves too little room between walls",
                       .what = "noise moves the end of a rod, over the room between opposite walls less a diameter, by",
                       .unit = "",
                       .remedy = "a wider box",
                       .diffusive = true,
                       .automatic = automatic_step_between_walls,
                       .advised = largest_step_between_walls,
                       .largest = largest_step_between_walls};
    for (std::size_t i = 0; i < rods.size(); ++i) {
        const RodMobility rod = mobility.of_rod(i);
        const double half = box.walls().turn_rods ? 0.5 * rods.length[i] : 0.0, room = narrowest - rods.diameter[i];
        limit.rate =
            std::max(limit.rate, 2.0 * kT * (rod.perpendicular + half * half * rod.rotational) / (room * room));
    }
    return {limit};
}

/// Thinner than any cell is but for one in a thousand; a function of the scene alone.
double lasting_diameter(const Scene& scene) {
    if (rods_are_given(scene)) return scene.rods.diameter;
    return scene.rods.diameter - farthest_deviation * scene.rods.diameter_deviation;
}

}  // namespace

StepLimit potential_limit(const Scene& scene, const Rods& rods, const MobilityOperator& mobility) {
    double largest = 0.0;
    for (std::size_t i = 0; i < rods.size(); ++i) {
        const RodMobility rod = mobility.of_rod(i);
        const double half = 0.5 * rods.length[i];
        largest = std::max(largest, std::max(rod.parallel, rod.perpendicular + half * half * rod.rotational));
    }
    const double energy = scene.contact.energy.value_or(scene.fluid.kT);
    const double curvature = wca_curvature(high_energy * thermal_energy(scene), smallest_diameter(scene, rods), energy);
    return {
        .key = "contact.energy",
        .value = text(energy),
        .harm = "makes a potential too stiff for the time step, at which two rods that meet with 5 kT are thrown apart",
        .what = "the way that they are thrown apart, over their overlap, is",
        .unit = "",
        .remedy = "a lower energy, or take hard rods",
        .rate = curvature * 2.0 * largest,
        .automatic = automatic_throw,
        .advised = advised_throw,
        .largest = largest_throw};
}

StepLimit spring_limit(const Scene& scene, std::span<const Spring> springs, const Rods& rods,
                       const MobilityOperator& mobility) {
    return {.key = "springs.file",
            .value = scene.springs.file,
            .harm = "names springs that are too stiff for the time step",
            .what = "the part of their stretch that they may lose (2 dt times stiffness times mobility) is",
            .unit = "",
            .remedy = "softer springs",
            .rate = spring_relaxation(springs, mobility_by_id(rods, mobility), 1.0),
            .automatic = automatic_relaxation,
            .advised = advised_relaxation,
            .largest = largest_relaxation};
}

std::vector<StepLimit> free_step_limits(const Scene& scene, const Mobility& model, const Box& box, const Rods& rods) {
    const double thinnest = smallest_diameter(scene, rods);
    std::vector<StepLimit> limits = motion_limits(scene, model, box, rods);
    if (grows(scene)) append(limits, motion_limits(scene, model, box, cells_to_come(scene, thinnest)));
    append(limits, growth_limits(scene, thinnest));
    return limits;
}

std::vector<StepLimit> step_limits(const Scene& scene, const Mobility& model, const Box& box, const Rods& rods,
                                   std::span<const Spring> springs) {
    const auto mobility = model.at(rods, box);
    const Scene hardest = scene_at_its_hardest(scene);
    std::vector<StepLimit> limits = free_step_limits(scene, model, box, rods);
    append(limits, image_limits(hardest, narrowest(scene, box, rods), rods, *mobility));
    append(limits, wall_limits(hardest, narrowest(scene, box, rods), rods, *mobility));
    append(limits, flow_limits(hardest, rods, *mobility));
    if (squeezes_box(scene)) append(limits, squeeze_limits(scene, rods));
    if (scene.pressure.external) append(limits, pressure_limits(scene, rods));
    if (scene.contact.model == ContactModel::wca) limits.push_back(potential_limit(hardest, rods, *mobility));
    if (!springs.empty()) limits.push_back(spring_limit(scene, springs, rods, *mobility));
    return limits;
}

std::vector<StepLimit> lasting_step_limits(const Scene& scene, const Mobility& model, const Box& box) {
    const double diameter = lasting_diameter(scene);
    const Rods cells = cells_to_come(scene, diameter);
    const auto mobility = model.at(cells, box);
    std::vector<StepLimit> limits = motion_limits(scene, model, box, cells);
    append(limits, growth_limits(scene, diameter));
    const Scene hardest = scene_at_its_hardest(scene);
    append(limits, image_limits(hardest, box, cells, *mobility));
    append(limits, wall_limits(hardest, box, cells, *mobility));
    if (scene.contact.model == ContactModel::wca) limits.push_back(potential_limit(hardest, cells, *mobility));
    return limits;
}

}  // namespace jostle
