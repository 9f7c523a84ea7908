#include "jostle/contact_problem/contact_blocks.hpp"

#include <algorithm>
#include <cmath>

#include "jostle/math/vectorised.hpp"

namespace jostle {

namespace {

/// The largest factor up to omega that keeps all forces of the pair >= 0. Clipping them one by one instead could raise
/// the energy where they are nearly dependent, and the sweeps would not end.
double feasible_relaxation(const CoupledBlock& pair, const Points& target, double omega) {
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
double solve(ScalarBlock<Real>& contact, double omega, const LocalRods<Real>& local_rods) {
    // Without a jump: which contacts push changes from sweep to sweep, and processors guess it badly.
    const Real relaxed = contact.gamma - static_cast<Real>(omega) * contact.gap_velocity(local_rods.velocities) *
                                             contact.inverse_diagonal;
    const Real change = std::max(relaxed, Real{0}) - contact.gamma;
    contact.apply_impulse(change, local_rods.velocities);
    return std::fabs(change) * contact.diagonal;
}

template <class Real>
double solve(CoupledBlock& pair, double omega, const LocalRods<Real>& local_rods) {
    const ContactVelocity i = velocity_of_body(pair.i, local_rods.velocities);
    const ContactVelocity j = velocity_of_body(pair.j, local_rods.velocities);
    Points velocity{}, target{};
    bool idle = true;
    for (std::uint32_t a = 0; a < pair.count; ++a) {
        velocity[a] = pair.points[a].gap_velocity(i, j);
        target[a] = pair.points[a].gamma;
        idle = idle && target[a] == 0.0 && velocity[a] >= 0.0;
    }
    if (idle) return 0.0;
    solve_block_problem(pair, velocity, target);
    const double factor = feasible_relaxation(pair, target, omega);
    double largest = 0.0;
    ContactForce on_i, on_j;
    for (std::uint32_t a = 0; a < pair.count; ++a) {
        CoupledBlock::Point& point = pair.points[a];
        const double change = std::max(point.gamma + factor * (target[a] - point.gamma), 0.0) - point.gamma;
        point.gamma += change;
        add_contact_force(change, point, on_i, on_j);
        largest = std::max(largest, std::fabs(change) * pair.matrix[a][a]);
    }
    const auto apply_impulse = [&local_rods](std::uint32_t local, const ContactForce& by) {
        local_rods.velocities[local].lanes +=
            SpatialVector<Real>(velocity_of(local_rods.rods[local], by.force, by.moment)).lanes;
    };
    if (pair.i != no_local_index) apply_impulse(pair.i, on_i);
    apply_impulse(pair.j, on_j);
    return largest;
}

template <class Item, class Real>
double solve_all(std::span<Item> items, std::span<Visit> visits, const Relaxation& by,
                 const LocalRods<Real>& local_rods) {
    double largest = 0.0;
    for (std::size_t k = 0; k < items.size(); ++k) {
        Visit& visit = visits[k];
        SpatialVector<Real>&at_i = local_rods.velocities[visit.i], &at_j = local_rods.velocities[visit.j];
        if (visit.solved > at_i.stirred() && visit.solved > at_j.stirred()) continue;
        const double change = solve(items[k], by.omega, local_rods);
        visit.solved = by.sweep;
        if (change > by.still) {
            at_i.stir(static_cast<Real>(by.sweep));
            at_j.stir(static_cast<Real>(by.sweep));
        }
        largest = std::max(largest, change);
    }
    return largest;
}

/// Each moves its forces on by beta times their last change, solves its own contact problem from there, and returns
/// what that was.
template <class Real>
double move_on(ScalarBlock<Real>& contact, Real& last, double beta, const LocalRods<Real>& local_rods) {
    const Real before = contact.gamma;
    contact.gamma += static_cast<Real>(beta) * last;
    const double change = solve(contact, 1.0, local_rods);
    last = contact.gamma - before;
    return change;
}

template <class Real>
double move_on(CoupledBlock& pair, Points& last, double beta, const LocalRods<Real>& local_rods) {
    Points before{};
    for (std::uint32_t a = 0; a < pair.count; ++a) {
        before[a] = pair.points[a].gamma;
        pair.points[a].gamma += beta * last[a];
    }
    const double change = solve(pair, 1.0, local_rods);
    for (std::uint32_t a = 0; a < pair.count; ++a) last[a] = pair.points[a].gamma - before[a];
    return change;
}

template <class Item, class Real>
double move_all_on(std::span<Item> items, std::span<typename Item::Forces> last, double beta,
                   const LocalRods<Real>& local_rods) {
    double change = 0.0;
    for (std::size_t k = 0; k < items.size(); ++k)
        change = std::max(change, move_on(items[k], last[k], beta, local_rods));
    return change;
}

}  // namespace

// One for each, as only plain functions can be compiled for several processors.
JOSTLE_VECTORISED double sweep_over(std::span<ScalarBlock<float>> contacts, std::span<Visit> visits,
                                    const Relaxation& by, const LocalRods<float>& local_rods) {
    return solve_all(contacts, visits, by, local_rods);
}
JOSTLE_VECTORISED double sweep_over(std::span<ScalarBlock<double>> contacts, std::span<Visit> visits,
                                    const Relaxation& by, const LocalRods<double>& local_rods) {
    return solve_all(contacts, visits, by, local_rods);
}
JOSTLE_VECTORISED double sweep_over(std::span<CoupledBlock> pairs, std::span<Visit> visits, const Relaxation& by,
                                    const LocalRods<float>& local_rods) {
    return solve_all(pairs, visits, by, local_rods);
}
JOSTLE_VECTORISED double sweep_over(std::span<CoupledBlock> pairs, std::span<Visit> visits, const Relaxation& by,
                                    const LocalRods<double>& local_rods) {
    return solve_all(pairs, visits, by, local_rods);
}

JOSTLE_VECTORISED double sweep_on(std::span<ScalarBlock<float>> contacts, std::span<float> last, double beta,
                                  const LocalRods<float>& local_rods) {
    return move_all_on(contacts, last, beta, local_rods);
}
JOSTLE_VECTORISED double sweep_on(std::span<ScalarBlock<double>> contacts, std::span<double> last, double beta,
                                  const LocalRods<double>& local_rods) {
    return move_all_on(contacts, last, beta, local_rods);
}
JOSTLE_VECTORISED double sweep_on(std::span<CoupledBlock> pairs, std::span<Points> last, double beta,
                                  const LocalRods<float>& local_rods) {
    return move_all_on(pairs, last, beta, local_rods);
}
JOSTLE_VECTORISED double sweep_on(std::span<CoupledBlock> pairs, std::span<Points> last, double beta,
                                  const LocalRods<double>& local_rods) {
    return move_all_on(pairs, last, beta, local_rods);
}

}  // namespace jostle
