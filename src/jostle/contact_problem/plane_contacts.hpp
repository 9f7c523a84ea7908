#pragma once

#include <vector>

#include "jostle/contact_problem/contact_blocks.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/parallel/ranks.hpp"

namespace jostle {

/// The contacts of one colour with a plane that they push (theory, eq. 10.3a). No two share a rod, and all share the
/// plane: they are solved together. With all other forces as they are, the force of contact l follows from the plane's
/// velocity v, and v from all of them,
///
///     gamma_l(v) = max(0, v_l - v)/a_l,   v = v_others + m sum_l gamma_l(v),
///
/// m: the plane's mobility; a_l: A_ll less the plane's part; v_l: the velocity at which the plane leaves the rod. The
/// right side falls with v, so that one v solves it.
template <class Real>
class PlaneContacts {
public:
    void push_back(const ScalarBlock<Real>& contact) { contacts_.push_back(contact); }
    /// To be called by all ranks together after contacts have been added.
    void tell_ranks(const Ranks& ranks) { any_ = ranks.any(!contacts_.empty()); }

    /// Solves them, and keeps the velocities of the plane and of the rods up to date. Returns the largest change of a
    /// gap velocity by the contact's own force, or by the plane. To be called by all ranks together, each with its own
    /// contacts; what comes out has the same bits for any order of the contacts.
    double sweep(double& plane_velocity, double mobility, const Relaxation& by, const LocalRods<Real>& local_rods,
                 const Ranks& ranks);

    template <class Body>
    void for_each(Body&& body) {
        parallel_for(contacts_.size(), [&](std::size_t k) { body(contacts_[k]); });
    }

private:
    double solved_velocity(double begin, double of_others, double mobility, const Ranks& ranks) const;

    /// A force by the velocity of the plane.
    struct Answer {
        double leaves = 0.0;            ///< v_l
        double inverse_diagonal = 0.0;  ///< 1/a_l
    };
    std::vector<ScalarBlock<Real>> contacts_;
    std::vector<Answer> answers_;  ///< (contacts) in the present sweep
    bool any_ = false;             ///< on any rank
};

extern template class PlaneContacts<float>;
extern template class PlaneContacts<double>;

}  // namespace jostle
