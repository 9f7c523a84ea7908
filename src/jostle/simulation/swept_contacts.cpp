#include "jostle/simulation/swept_contacts.hpp"

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
        const double force = pair.contact[a].gamma;
        if (target[a] < force) factor = std::min(factor, force / (force - target[a]));
    }
    return factor;
}

/// Each solves its own contact problem with all other forces as they are, over-relaxed; they return the change of the
/// gap velocities by their own forces.
template <class Real>
double solve(SweptContact<Real>& contact, double omega, Wide<Real>* velocities) {
    // Without a jump: which contacts push changes from sweep to sweep, and processors guess it badly.
    const Real relaxed =
        contact.gamma - static_cast<Real>(omega) * contact.gap_velocity(velocities) * contact.inverse_diagonal;
    const Real change = std::max(relaxed, Real{0}) - contact.gamma;
    contact.push(change, velocities);
    return std::fabs(change) * contact.diagonal;
}

template <class Real>
double solve(SweptPair& pair, double omega, Wide<Real>* velocities) {
    Points velocity{}, target{};
    bool idle = true;
    for (std::uint32_t a = 0; a < pair.count; ++a) {
        velocity[a] = pair.contact[a].gap_velocity(velocities);
        target[a] = pair.contact[a].gamma;
        idle = idle && target[a] == 0.0 && velocity[a] >= 0.0;
    }
    if (idle) return 0.0;
    solve_own_problem(pair, velocity, target);
    const double factor = feasible_relaxation(pair, target, omega);
    double largest = 0.0;
    for (std::uint32_t a = 0; a < pair.count; ++a) {
        const double gamma = pair.contact[a].gamma;
        const double change = std::max(gamma + factor * (target[a] - gamma), 0.0) - gamma;
        if (change == 0.0) continue;
        pair.contact[a].push(change, velocities);
        largest = std::max(largest, std::fabs(change) * pair.matrix[a][a]);
    }
    return largest;
}

template <class Item, class Real>
double solve_all(std::span<Item> items, double omega, Wide<Real>* velocities, float* stirred) {
    double largest = 0.0;
    for (Item& item : items) {
        const double change = solve(item, omega, velocities);
        largest = std::max(largest, change);
        if (stirred == nullptr) continue;
        const auto& first = contacts_of(item).front();
        for (const std::uint32_t place : {first.i, first.j})
            stirred[place] = std::max(stirred[place], static_cast<float>(change));
    }
    return largest;
}

}  // namespace

// One for each, as only plain functions can be compiled for several processors.
JOSTLE_VECTORISED double sweep_over(std::span<SweptContact<float>> contacts, double omega, Wide<float>* velocities,
                                    float* stirred) {
    return solve_all(contacts, omega, velocities, stirred);
}
JOSTLE_VECTORISED double sweep_over(std::span<SweptContact<double>> contacts, double omega, Wide<double>* velocities,
                                    float* stirred) {
    return solve_all(contacts, omega, velocities, stirred);
}
JOSTLE_VECTORISED double sweep_over(std::span<SweptPair> pairs, double omega, Wide<float>* velocities, float* stirred) {
    return solve_all(pairs, omega, velocities, stirred);
}
JOSTLE_VECTORISED double sweep_over(std::span<SweptPair> pairs, double omega, Wide<double>* velocities,
                                    float* stirred) {
    return solve_all(pairs, omega, velocities, stirred);
}

}  // namespace jostle
