#include "jostle/contact_problem/plane_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "jostle/parallel/sum_over_ranks.hpp"

namespace jostle {

template <class Real>
double PlaneContacts<Real>::sweep(double& plane_velocity, double mobility, const Relaxation& by,
                                  const LocalRods<Real>& local_rods, const Ranks& ranks) {
    if (!any_) return 0.0;
    const auto force = [this](std::size_t k) { return static_cast<double>(contacts_[k].gamma); };
    answers_.resize(contacts_.size());
    parallel_for(contacts_.size(), [&](std::size_t k) {
        const ScalarBlock<Real>& contact = contacts_[k];
        const double own = static_cast<double>(contact.diagonal) - mobility;
        answers_[k] = {own * force(k) - static_cast<double>(contact.gap_velocity(local_rods.velocities)), 1.0 / own};
    });
    const double of_others = plane_velocity - mobility * sum_over_ranks<double>(ranks, contacts_.size(), force);
    const double velocity = solved_velocity(plane_velocity, of_others, mobility, ranks);
    const double largest = parallel_max(contacts_.size(), 0.0, [&](std::size_t k) {
        ScalarBlock<Real>& contact = contacts_[k];
        const double target = std::max(0.0, answers_[k].leaves - velocity) * answers_[k].inverse_diagonal;
        const Real change = static_cast<Real>(target) - contact.gamma;
        contact.apply_impulse(change, local_rods.velocities);
        const double opened = std::fabs(static_cast<double>(change * contact.diagonal));
        if (opened > by.still) local_rods.velocities[contact.j].stir(static_cast<Real>(by.sweep));
        return opened;
    });
    const double before = plane_velocity;
    plane_velocity = of_others + mobility * sum_over_ranks<double>(ranks, contacts_.size(), force);
    return std::max(largest, std::fabs(plane_velocity - before));
}

/// Newton's method from `begin`: the plane's velocity if those contacts pushed that push at the last one. From the
/// first step on these velocities rise, for the forces are convex functions of v, and the last is exact.
template <class Real>
double PlaneContacts<Real>::solved_velocity(double begin, double of_others, double mobility, const Ranks& ranks) const {
    struct Pushing {
        double force, inverse_diagonal;  ///< sums of v_l/a_l and 1/a_l
    };
    const auto next = [&](double velocity) {
        const auto sums = sum_over_ranks<Pushing>(ranks, answers_.size(), [&](std::size_t k) {
            const auto [leaves, inverse_diagonal] = answers_[k];
            return leaves > velocity ? Pushing{leaves * inverse_diagonal, inverse_diagonal} : Pushing{};
        });
        return (of_others + mobility * sums.force) / (1.0 + mobility * sums.inverse_diagonal);
    };
    double velocity = next(begin);
    for (double better = next(velocity); better > velocity; better = next(velocity)) velocity = better;
    return velocity;
}

template class PlaneContacts<float>;
template class PlaneContacts<double>;

}  // namespace jostle
