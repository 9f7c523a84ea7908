#include "jostle/measurement/step_sums.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <type_traits>
#include <utility>

#include "jostle/domain/homes.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/motion/self_propulsion.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/schedule.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/stress/fluid_stress.hpp"

namespace jostle {

namespace {

/// The sums of `StepSums` that are numbers, each with its name in checkpoints.
template <class AnySums, class Visitor>
void for_each_sum(AnySums& sums, Visitor&& visit) {
    visit("steps", sums.steps);
    visit("rods", sums.rods);
    visit("collision_virial", sums.collision_virial);
    visit("spring_virial", sums.spring_virial);
    visit("centre_of_mass_virial", sums.centre_of_mass_virial);
    visit("centre_line_virial", sums.centre_line_virial);
    visit("wall_force", sums.wall_force);
    visit("contacts", sums.contacts);
    visit("active_contacts", sums.active_contacts);
    visit("iterations", sums.iterations);
    visit("residual", sums.residual);
    visit("max_overlap", sums.max_overlap);
    visit("run_max_overlap", sums.run_max_overlap);
}

template <class Sum>
auto numbers_of(Sum& sum) {
    if constexpr (std::is_same_v<std::remove_const_t<Sum>, Mat3>)
        return std::span(sum.m);
    else if constexpr (std::is_floating_point_v<std::remove_const_t<Sum>>)
        return std::span(&sum, 1);
    else
        return std::span(sum);
}

/// What the active stress has to know of a rod.
struct Swimmer {
    std::uint64_t id;
    Vec3 centre, force;
    Image image;
};

/// Of ranks whose ids follow each other, all for rank 0: lists one after the other, single numbers as they are.
NamedNumbers at_first_rank(NamedNumbers numbers, const Ranks& ranks) {
    if (ranks.alone()) return numbers;
    for (const char* name : {"id", "newer", "older"}) numbers[name] = ranks.gather_at_first(numbers[name]);
    return numbers;
}

}  // namespace

void StepSums::add(const StepReport& report) {
    steps += 1.0;
    rods += static_cast<double>(report.rods);
    collision_virial += report.collision_virial;
    spring_virial += report.spring_virial;
    centre_of_mass_virial += report.centre_of_mass_virial;
    centre_line_virial += report.centre_line_virial;
    if (torque_virial) *torque_virial += report.torque_virial;
    if (fixed_rod_force) *fixed_rod_force += report.fixed_rod_force;
    if (held_back) *held_back += report.box_held_back ? 1.0 : 0.0;
    for (std::size_t wall = 0; wall < max_walls; ++wall) wall_force[wall] += report.wall_force[wall];
    contacts += static_cast<double>(report.contacts);
    active_contacts += static_cast<double>(report.active_contacts);
    iterations += static_cast<double>(report.iterations);
    residual = std::max(residual, report.residual);
    max_overlap = std::max(max_overlap, report.max_overlap);
    run_max_overlap = std::max(run_max_overlap, report.max_overlap);
}

void StepSums::stretch(const StepReport& report) {
    const Vec3& by = report.stretch;
    if (by == Vec3{1, 1, 1}) return;
    const double volume = by.x * by.y * by.z;
    rods *= volume;
    for (Mat3* virial : {&collision_virial, &spring_virial, &centre_of_mass_virial, &centre_line_virial})
        *virial = volume * *virial;
    if (torque_virial) *torque_virial = volume * *torque_virial;
    if (active_stress) active_stress->stretch(by);
}

void StepSums::add(const StepReport& report, const Simulation& simulation) {
    stretch(report);
    add(report);
    if (kT) *kT += simulation.settings().kT;
    if (active_stress) {
        std::vector<ActiveStress::Division> divisions;
        for (const LineageEvent& event : simulation.lineage())
            if (event.kind == LineageEvent::Kind::birth) divisions.push_back({event.mother, event.id});
        active_stress->divide(simulation.rods(), simulation.box(), divisions);
    }
    if (!field) return;
    field->fit(simulation.box());
    add_to_field(simulation);
}

/// Places are added up in the order of ids, and so by one rank.
void StepSums::add_to_field(const Simulation& simulation) {
    const Domain& domain = simulation.domain();
    const double temperature = simulation.settings().kT;
    if (!domain.is_shared()) {
        field->add(simulation.collision_moments(), simulation.rods(), temperature);
        return;
    }
    const CollisionMoments moments = at_first_rank(simulation.collision_moments(), domain.ranks());
    const Rods all = simulation.rods_in_order().whole();
    if (domain.ranks().rank() == 0) field->add(moments, all, temperature);
}

void StepSums::measure_swimmers(const Scene& scene, const Simulation& simulation) {
    if (!active_stress) return;
    const Rods& swimmers = simulation.rods();
    const Domain& domain = simulation.domain();
    const StepContext context = {scene.seed, simulation.clock().step, simulation.settings().time_step};
    const auto mobility = simulation.mobility().at(swimmers, simulation.box());
    const Swimming now = swimming_of(scene_at(scene, simulation.clock().time));
    const SelfPropulsion swimming(now);
    const std::vector<Vec3> force = swimming.propulsion(swimmers, *mobility, context);
    if (!domain.is_shared()) {
        active_virial = active_stress->virial(swimmers, simulation.box(), force);
        if (!stirs(scene)) return;
        dipole_virial = sum_of_dipole_stresses(swimmers, swimming.stresslets(swimmers, context).dipole);
        thermal_virial = sum_of_thermal_stresses(swimmers, simulation.settings().kT);
        return;
    }
    std::vector<Swimmer> own;
    for (std::size_t row = 0; row < domain.owned_of(swimmers.size()); ++row)
        own.push_back({swimmers.id[row], swimmers.centre[row], force[row], swimmers.image[row]});
    Rods at_home;
    std::vector<Vec3> force_at_home;
    for (const Swimmer& swimmer :
         Homes(domain.ranks(), simulation.rods_in_all()).bring(std::span<const Swimmer>(own))) {
        at_home.push_back(swimmer.id, swimmer.centre, {}, 0.0, 0.0);
        at_home.image.back() = swimmer.image;
        force_at_home.push_back(swimmer.force);
    }
    active_virial = active_stress->virial(at_home, simulation.box(), force_at_home, domain.ranks());
}

void StepSums::share(const Ranks& ranks) {
    if (ranks.alone() || !active_stress) return;
    const auto [begin, end] = Homes(ranks, active_stress->size()).range();
    active_stress->keep(begin, end);
}

void StepSums::start_row() {
    StepSums fresh;
    if (kT) fresh.kT = 0.0;
    if (fixed_rod_force) fresh.fixed_rod_force.emplace();
    if (torque_virial) fresh.torque_virial.emplace();
    if (held_back) fresh.held_back = 0.0;
    fresh.run_max_overlap = run_max_overlap;
    fresh.active_stress = std::move(active_stress);
    fresh.field = std::move(field);
    *this = std::move(fresh);
}

NamedNumbers StepSums::to_named(const Ranks& ranks) const {
    NamedNumbers numbers;
    for_each_sum(*this, [&](const char* name, const auto& sum) {
        const std::span<const double> values = numbers_of(sum);
        numbers[name].assign(values.begin(), values.end());
    });
    if (kT) numbers["kT"] = {*kT};
    if (held_back) numbers["held_back"] = {*held_back};
    if (torque_virial) numbers["torque_virial"].assign(torque_virial->m.begin(), torque_virial->m.end());
    if (const auto& force = fixed_rod_force) numbers["fixed_rod_force"] = {force->x, force->y, force->z};
    if (active_stress) add_under("active_stress", numbers, at_first_rank(active_stress->to_named(), ranks));
    if (field) add_under("field", numbers, field->to_named());
    return numbers;
}

StepSums StepSums::from_named(NamedNumbers numbers, const Scene& scene, const Box& box) {
    StepSums sums;
    const auto take = [&](const char* name, std::span<double> values) {
        const auto found = numbers.find(name);
        if (found == numbers.end() || found->second.size() != values.size())
            throw InputError({.key = "checkpoint",
                              .problem = std::string("it lacks the sum \"") + name + "\" of a run of this scene",
                              .suggestion = "Start anew with --fresh"});
        std::copy(found->second.begin(), found->second.end(), values.begin());
    };
    for_each_sum(sums, [&](const char* name, auto& sum) { take(name, numbers_of(sum)); });
    if (!scene.schedule.kT.empty()) take("kT", {&sums.kT.emplace(), 1});
    if (scene.pressure.external) take("held_back", {&sums.held_back.emplace(), 1});
    if (box.fixed_rods()) {
        std::array<double, 3> force{};
        take("fixed_rod_force", force);
        sums.fixed_rod_force = Vec3{force[0], force[1], force[2]};
    }
    if (has_torques(scene)) take("torque_virial", sums.torque_virial.emplace().m);
    if (swims(scene)) sums.active_stress = ActiveStress::from_named(taken_under("active_stress", numbers));
    if (scene.output.field_every == 0) return sums;
    NamedNumbers field_so_far = taken_under("field", numbers);
    sums.field = field_so_far.empty() ? make_field(scene, box) : StressField::from_named(std::move(field_so_far));
    return sums;
}

Checkpoint checkpoint_without_rods(const Simulation& simulation, const StepSums& sums, std::string scene) {
    Checkpoint checkpoint;
    checkpoint.scene = std::move(scene);
    checkpoint.state = simulation.state_without_rods();
    checkpoint.sums = sums.to_named(simulation.domain().ranks());
    return checkpoint;
}

StepSums first_sums(const Scene& scene, const Simulation& simulation) {
    StepSums sums;
    sums.field = make_field(scene, simulation.box());
    if (!scene.schedule.kT.empty()) sums.kT = 0.0;
    if (scene.pressure.external) sums.held_back = 0.0;
    if (has_torques(scene)) sums.torque_virial.emplace();
    if (simulation.box().fixed_rods()) sums.fixed_rod_force.emplace();
    if (!swims(scene)) return sums;
    const Rods& rods = simulation.rods();
    const double row_time = simulation.settings().time_step * static_cast<double>(scene.output.series_every);
    const auto mobility = simulation.mobility().at(rods, simulation.box());
    const double rows = std::ceil(active_stress_lag(scene, *mobility, rods.size()) / row_time - 1e-9);
    sums.active_stress.emplace(static_cast<std::uint64_t>(std::clamp(rows, 1.0, 1e15)));
    sums.active_stress->begin(rods, simulation.box());
    return sums;
}

}  // namespace jostle
