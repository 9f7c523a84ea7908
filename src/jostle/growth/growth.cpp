#include "jostle/growth/growth.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "jostle/error/refuse.hpp"
#include "jostle/math/random.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

constexpr int id_bits = 53;           ///< ids stay exact as double, as which tables hold them
constexpr double least_factor = 0.2;  ///< of a drawn rate or threshold to its mean
constexpr double least_share = 1e-9;  ///< of its rate, by which a stalled cell grows: (5.2) divides by it

double noisy_factor(double deviation, double normal) {
    return std::max(least_factor, 1.0 + deviation * normal);
}

/// Takes out the rows that are marked; the others keep their order.
void remove_rows(Rods& rods, const std::vector<bool>& marked) {
    const auto keep = [&](auto& values) {
        std::size_t to = 0;
        for (std::size_t from = 0; from < marked.size(); ++from)
            if (!marked[from]) values[to++] = values[from];
        values.resize(to);
    };
    keep(rods.centre);
    keep(rods.axis);
    keep(rods.length);
    keep(rods.diameter);
    keep(rods.id);
    keep(rods.image);
    keep(rods.cycle);
    if (!rods.speed.empty()) keep(rods.speed);
}

}  // namespace

void Growth::found(Rods& rods) const {
    rods.cycle.clear();
    rods.founder_bits = 0;
    for (std::size_t i = 0; i < rods.size(); ++i) {
        rods.founder_bits = std::max(rods.founder_bits, static_cast<int>(std::bit_width(rods.id[i])));
        rods.cycle.push_back(newborn(rods.id[i], rods.length[i], rods.diameter[i], 0, 0));
    }
}

CellCycle Growth::newborn(std::uint64_t id, double length, double diameter, std::uint64_t step,
                          std::uint64_t divisions) const {
    Normals xi{};
    fill_normals({seed_, divisions, Stream::growth, 0}, {&id, 1}, {&xi, 1});
    const double added = 0.5 * (law_.division_length + diameter), factor = noisy_factor(law_.division_deviation, xi[1]);
    CellCycle cycle;
    cycle.growth_rate = law_.rate * noisy_factor(law_.rate_deviation, xi[0]);
    cycle.birth_step = step;
    cycle.divisions = divisions;
    switch (law_.division) {
        case DivisionRule::sizer:
            cycle.division_at = law_.division_length * factor;
            break;
        case DivisionRule::adder:
            cycle.division_at = length + added * factor;
            break;
        case DivisionRule::timer:
            cycle.division_at = added / law_.rate * factor;
            break;
    }
    return cycle;
}

void Growth::lengthen(Rods& rods, double time_step) const {
    parallel_for(rods.size(),
                 [&](std::size_t i) { rods.length[i] += rods.cycle[i].share * rods.cycle[i].growth_rate * time_step; });
}

double Growth::stall_memory(double diameter) const {
    return law_.stall_memory.value_or(automatic_memory * 0.5 * (law_.division_length + diameter) / law_.rate);
}

void Growth::slow_down(Rods& rods, std::span<const std::uint32_t> rows, std::span<const ContactForce> forces,
                       double time_step) const {
    if (!law_.stall_force) return;
    std::vector<double> compression(rods.size(), 0.0);
    parallel_for(rows.size(), [&](std::size_t k) {
        const std::uint32_t row = rows[k];
        if (rods.length[row] > 0.0) compression[row] = -dot(forces[k].moment, rods.axis[row]) / rods.length[row];
    });
    parallel_for(rods.size(), [&](std::size_t i) {
        double& share = rods.cycle[i].share;
        const double weight = -std::expm1(-time_step / stall_memory(rods.diameter[i]));
        const double relative = std::max(0.0, compression[i] / *law_.stall_force);
        share *= (share + weight * (1.0 - share)) / (share + weight * relative);
        share = std::max(share, least_share);
    });
}

std::vector<LineageEvent> Growth::divide(Rods& rods, const Box& box, std::uint64_t step, double time_step) const {
    std::vector<LineageEvent> events;
    const std::size_t count = rods.size();
    std::vector<bool> dead(count, false);
    for (std::size_t i = 0; i < count; ++i) {
        if (law_.death_rate > 0.0 && dies(rods.id[i], step, time_step)) {
            dead[i] = true;
            events.push_back({LineageEvent::Kind::death, rods.id[i], rods.id[i], rods.length[i]});
        } else if (divides(rods, i, step, time_step)) {
            events.push_back(split(rods, i, box, step));
            dead.push_back(false);
        }
    }
    if (law_.death_rate > 0.0) remove_rows(rods, dead);
    std::sort(events.begin(), events.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    return events;
}

bool Growth::divides(const Rods& rods, std::size_t row, std::uint64_t step, double time_step) const {
    // Both daughters need room: a cell no longer than its diameter waits.
    if (rods.length[row] < rods.diameter[row]) return false;
    const CellCycle& cycle = rods.cycle[row];
    const double measured = law_.division == DivisionRule::timer
                                ? static_cast<double>(step - cycle.birth_step) * time_step
                                : rods.length[row];
    return measured >= cycle.division_at * (1.0 - 1e-12);
}

bool Growth::dies(std::uint64_t id, std::uint64_t step, double time_step) const {
    const double interval = static_cast<double>(law_.division_every) * time_step;
    return happens({seed_, step, Stream::death, id}, -std::expm1(-law_.death_rate * interval));
}

LineageEvent Growth::split(Rods& rods, std::size_t row, const Box& box, std::uint64_t step) const {
    const std::uint64_t mother = rods.id[row], divisions = rods.cycle[row].divisions;
    const int new_bit = rods.founder_bits + static_cast<int>(divisions);
    if (new_bit >= id_bits)
        refuse("growth", "cell " + std::to_string(mother),
               "has had " + std::to_string(divisions) + " divisions in its line",
               "at most " + std::to_string(id_bits - rods.founder_bits) + ": ids cannot tell more apart",
               "Start anew from its rods");
    const std::uint64_t daughter = mother | std::uint64_t{1} << new_bit;
    const double diameter = rods.diameter[row], length = 0.5 * (rods.length[row] - diameter);
    const Vec3 axis = rods.axis[row], step_along = 0.25 * (rods.length[row] + diameter) * axis;
    const Vec3 front = rods.centre[row] + step_along;
    const Image image = rods.image[row];

    const double share = rods.cycle[row].share;

    rods.centre[row] = rods.centre[row] - step_along;
    if (law_.daughters == DaughterDirection::opposite) rods.axis[row] = Vec3{} - axis;  // 0 stays 0, not -0
    rods.length[row] = length;
    rods.cycle[row] = newborn(mother, length, diameter, step, divisions + 1);
    rods.cycle[row].share = share;
    box.wrap(rods.centre[row], rods.image[row]);

    rods.push_back(daughter, front, axis, length, diameter);
    rods.image.back() = image;
    if (!rods.speed.empty()) rods.speed.push_back(rods.speed[row]);
    rods.cycle.push_back(newborn(daughter, length, diameter, step, divisions + 1));
    rods.cycle.back().share = share;
    box.wrap(rods.centre.back(), rods.image.back());
    return {LineageEvent::Kind::birth, daughter, mother, length};
}

}  // namespace jostle
