#include "jostle/contact_problem/swept_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "jostle/math/vectorised.hpp"

namespace jostle {

namespace {

/// The largest factor up to omega that keeps all forces of the pair >= 0. Clipping them one by one instead could raise
/// the energy where they are nearly dependent, and the sweeps would not end.
double feasible_relaxation(const SweptPair& pair, const Points& target, double omega) {
    double factor = omega;
    for (std::uint32_t a = 0; a < pair.count; ++a) {
        const double force = pair.points[a].gamma;
        if (target[a] < force) factor = std::min(factor, force / (force - target[a]));
    }
    return factor;
}

/// Each solves its own contact problem with all other forces as they are, over-relaxed; they return the change of the
/// gap velocities by their own forces.
template <class Real>
double solve(SweptContact<Real>& contact, double omega, const Places<Real>& places) {
    // Without a jump: which contacts push changes from sweep to sweep, and processors guess it badly.
    const Real relaxed =
        contact.gamma - static_cast<Real>(omega) * contact.gap_velocity(places.velocities) * contact.inverse_diagonal;
    const Real change = std::max(relaxed, Real{0}) - contact.gamma;
    contact.push(change, places.velocities);
    return std::fabs(change) * contact.diagonal;
}

template <class Real>
double solve(SweptPair& pair, double omega, const Places<Real>& places) {
    const ContactVelocity i = places.velocities[pair.i].velocity(), j = places.velocities[pair.j].velocity();
    Points velocity{}, target{};
    bool idle = true;
    for (std::uint32_t a = 0; a < pair.count; ++a) {
        velocity[a] = pair.points[a].gap_velocity(i, j);
        target[a] = pair.points[a].gamma;
        idle = idle && target[a] == 0.0 && velocity[a] >= 0.0;
    }
    if (idle) return 0.0;
    solve_own_problem(pair, velocity, target);
    const double factor = feasible_relaxation(pair, target, omega);
    double largest = 0.0;
    ContactForce on_i, on_j;
    for (std::uint32_t a = 0; a < pair.count; ++a) {
        SweptPair::Point& point = pair.points[a];
        const double change = std::max(point.gamma + factor * (target[a] - point.gamma), 0.0) - point.gamma;
        point.gamma += change;
        add_push(change, point, on_i, on_j);
        largest = std::max(largest, std::fabs(change) * pair.matrix[a][a]);
    }
    const auto push = [&places](std::uint32_t place, const ContactForce& by) {
        places.velocities[place].lanes += Wide<Real>(velocity_of(places.rods[place], by.force, by.lever)).lanes;
    };
    push(pair.i, on_i);
    push(pair.j, on_j);
    return largest;
}

template <class Item, class Real>
double solve_all(std::span<Item> items, double omega, const Places<Real>& places) {
    double largest = 0.0;
    for (Item& item : items) {
        const double change = solve(item, omega, places);
        largest = std::max(largest, change);
        if (places.stirred == nullptr) continue;
        for (const std::uint32_t place : {item.i, item.j})
            places.stirred[place] = std::max(places.stirred[place], static_cast<float>(change));
    }
    return largest;
}

}  // namespace

// One for each, as only plain functions can be compiled for several processors.
JOSTLE_VECTORISED double sweep_over(std::span<SweptContact<float>> contacts, double omega,
                                    const Places<float>& places) {
    return solve_all(contacts, omega, places);
}
JOSTLE_VECTORISED double sweep_over(std::span<SweptContact<double>> contacts, double omega,
                                    const Places<double>& places) {
    return solve_all(contacts, omega, places);
}
JOSTLE_VECTORISED double sweep_over(std::span<SweptPair> pairs, double omega, const Places<float>& places) {
    return solve_all(pairs, omega, places);
}
JOSTLE_VECTORISED double sweep_over(std::span<SweptPair> pairs, double omega, const Places<double>& places) {
    return solve_all(pairs, omega, places);
}

}  // namespace jostle
