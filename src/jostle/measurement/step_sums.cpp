#include "jostle/measurement/step_sums.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "jostle/error/input_error.hpp"
#include "jostle/motion/self_propulsion.hpp"
#include "jostle/rods/space_filling_order.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/setup/assemble.hpp"

namespace jostle {

void StepSums::add(const StepReport& report) {
    steps += 1.0;
    rods += static_cast<double>(report.rods);
    collision_virial += report.collision_virial;
    spring_virial += report.spring_virial;
    centre_of_mass_virial += report.centre_of_mass_virial;
    centre_line_virial += report.centre_line_virial;
    contacts += static_cast<double>(report.contacts);
    active_contacts += static_cast<double>(report.active_contacts);
    iterations += static_cast<double>(report.iterations);
    residual = std::max(residual, report.residual);
    max_overlap = std::max(max_overlap, report.max_overlap);
    run_max_overlap = std::max(run_max_overlap, report.max_overlap);
}

void StepSums::add(const StepReport& report, const Simulation& simulation) {
    add(report);
    if (active_stress) {
        std::vector<ActiveStress::Division> divisions;
        for (const LineageEvent& event : simulation.lineage())
            if (event.kind == LineageEvent::Kind::birth) divisions.push_back({event.mother, event.id});
        active_stress->divide(simulation.rods(), simulation.box(), divisions);
    }
    if (field) field->add(simulation.collision_moments(), simulation.rods(), simulation.settings().kT);
}

void StepSums::look_at_swimmers(const Scene& scene, const Simulation& simulation) {
    if (!active_stress) return;
    const Rods& swimmers = simulation.rods();
    const StepContext context = {scene.seed, simulation.clock().step, simulation.settings().time_step};
    const std::vector<Vec3> force = SelfPropulsion(swimming_of(scene)).forces(swimmers, simulation.mobility(), context);
    active_virial = active_stress->virial(swimmers, simulation.box(), force);
}

void StepSums::start_row() {
    StepSums fresh;
    fresh.run_max_overlap = run_max_overlap;
    fresh.active_stress = std::move(active_stress);
    fresh.field = std::move(field);
    *this = std::move(fresh);
}

std::vector<double> StepSums::to_numbers() const {
    std::vector<double> numbers = {steps,    contacts,    active_contacts, iterations,
                                   residual, max_overlap, run_max_overlap, rods};
    for (const Mat3* sum : {&collision_virial, &spring_virial, &centre_of_mass_virial, &centre_line_virial})
        numbers.insert(numbers.end(), sum->m.begin(), sum->m.end());
    const auto append = [&](const std::vector<double>& more) {  // 0 numbers where there is no such thing
        numbers.push_back(static_cast<double>(more.size()));
        numbers.insert(numbers.end(), more.begin(), more.end());
    };
    append(active_stress ? active_stress->to_numbers() : std::vector<double>{});
    append(field ? field->to_numbers() : std::vector<double>{});
    return numbers;
}

StepSums StepSums::from_numbers(const std::vector<double>& numbers, const Scene& scene) {
    constexpr std::size_t sums_count = 8 + 4 * 9;
    const auto require = [](bool sound) {
        if (!sound)
            throw InputError({.key = "checkpoint",
                              .problem = "it holds other sums than a run of this scene by this version of jostle",
                              .suggestion = "Start anew with --fresh"});
    };
    require(numbers.size() >= sums_count);
    StepSums sums;
    sums.steps = numbers[0];
    sums.contacts = numbers[1];
    sums.active_contacts = numbers[2];
    sums.iterations = numbers[3];
    sums.residual = numbers[4];
    sums.max_overlap = numbers[5];
    sums.run_max_overlap = numbers[6];
    sums.rods = numbers[7];
    auto from = numbers.begin() + 8;
    for (Mat3* sum :
         {&sums.collision_virial, &sums.spring_virial, &sums.centre_of_mass_virial, &sums.centre_line_virial}) {
        std::copy(from, from + 9, sum->m.begin());
        from += 9;
    }
    std::span<const double> rest = std::span(numbers).subspan(sums_count);
    const auto take = [&] {
        require(!rest.empty() && rest[0] >= 0.0 && rest[0] < static_cast<double>(rest.size()));
        const std::span<const double> taken = rest.subspan(1, static_cast<std::size_t>(rest[0]));
        rest = rest.subspan(1 + taken.size());
        return taken;
    };
    if (const auto positions = take(); !positions.empty()) sums.active_stress = ActiveStress::from_numbers(positions);
    if (const auto field = take(); !field.empty()) sums.field = StressField::from_numbers(field);
    require(rest.empty() && sums.active_stress.has_value() == (scene.motion.self_propulsion != 0.0) &&
            sums.field.has_value() == (scene.output.field_every > 0));
    return sums;
}

Checkpoint checkpoint_of(const Simulation& simulation, const StepSums& sums, std::string scene) {
    Checkpoint checkpoint;
    checkpoint.scene = std::move(scene);
    checkpoint.step = simulation.clock().step;
    checkpoint.time = simulation.clock().time;
    checkpoint.box = simulation.box();
    checkpoint.rods = in_order_of_ids(simulation.rods());
    checkpoint.springs.assign(simulation.springs().begin(), simulation.springs().end());
    checkpoint.last_forces = simulation.last_forces();
    checkpoint.accumulators = sums.to_numbers();
    return checkpoint;
}

StepSums first_sums(const Scene& scene, const Simulation& simulation) {
    StepSums sums;
    sums.field = make_field(scene, simulation.box());
    if (scene.motion.self_propulsion == 0.0) return sums;
    const Rods& rods = simulation.rods();
    const double row_time = simulation.settings().time_step * static_cast<double>(scene.output.series_every);
    const double rows = std::ceil(active_stress_lag(scene, simulation.mobility(), rods.size()) / row_time - 1e-9);
    sums.active_stress.emplace(static_cast<std::uint64_t>(std::clamp(rows, 1.0, 1e15)));
    sums.active_stress->begin(rods, simulation.box());
    return sums;
}

}  // namespace jostle
