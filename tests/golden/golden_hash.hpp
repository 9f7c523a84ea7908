#pragma once

#include <string_view>
#include <vector>

#include "jostle/disk/checksum.hpp"
#include "jostle/simulation/simulation.hpp"

namespace jostle {

/// The bits of numbers, one after the other, as one number (XXH3).
class Hash {
public:
    template <class... Numbers>
    void add(const Numbers&... numbers) {
        (add_one(numbers), ...);
    }
    std::uint64_t value() const { return checksum_.value(); }

private:
    template <class Number>
    void add_one(const Number& number) {
        static_assert(std::has_unique_object_representations_v<Number> || std::is_floating_point_v<Number>);
        checksum_.add({reinterpret_cast<const char*>(&number), sizeof number});
    }
    void add_one(const std::vector<double>& numbers) {
        for (const double number : numbers) add_one(number);
    }
    void add_one(const Vec3& vector) { add(vector.x, vector.y, vector.z); }
    void add_one(const Mat3& matrix) {
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column) add(matrix(row, column));
    }

    RunningChecksum checksum_;
};

/// The bits of a simulation's state, its rods in the order of their ids.
inline std::uint64_t state_hash(const Simulation& simulation) {
    const State state = in_order_of_ids(simulation.state());
    const Rods& rods = state.rods;
    Hash hash;
    hash.add(state.clock.step, state.clock.time, state.box.edges(), state.box.offset());
    if (state.box_force) hash.add(*state.box_force);
    for (std::size_t i = 0; i < rods.size(); ++i) {
        hash.add(rods.id[i], rods.centre[i], rods.axis[i], rods.length[i], rods.diameter[i]);
        for (const std::int32_t crossed : rods.image[i]) hash.add(crossed);
        if (!rods.speed.empty()) hash.add(rods.speed[i]);
        if (rods.cycle.empty()) continue;
        const CellCycle& cycle = rods.cycle[i];
        hash.add(cycle.growth_rate, cycle.division_at, cycle.birth_step, cycle.divisions, cycle.share);
    }
    for (const Spring& spring : state.springs) {
        hash.add(spring.rod_1, spring.rod_2, spring.s_1, spring.s_2);
        for (const std::int32_t crossed : spring.image) hash.add(crossed);
    }
    for (const PreviousForce& force : state.previous_forces)
        hash.add(force.i, force.j, force.feature, force.upper, force.gamma);
    return hash.value();
}

/// Adds the numbers that a step reports, and the forces of its contacts.
inline void add_results(Hash& hash, const StepReport& report, const Simulation& simulation) {
    hash.add(report.collision_virial, report.spring_virial, report.max_overlap, report.residual, report.iterations,
             report.contacts, report.active_contacts);
    for (const std::size_t l : order_of_ids(simulation.contacts(), simulation.contact_ids()))
        hash.add(simulation.contact_solution().gamma[l]);
}

}  // namespace jostle
