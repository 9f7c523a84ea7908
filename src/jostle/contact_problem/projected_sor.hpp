#pragma once

#include "jostle/contact_problem/contact_solver.hpp"

namespace jostle {

/// Projected successive over-relaxation (SOR) on the rods' velocities: for mobilities that do not couple rods.
///
/// The velocities V = M D gamma are kept up to date, and the contacts of one pair after another are solved for the
/// velocities as they are (a pair may touch at up to three points, which are nearly dependent, so these are solved
/// together):
///
///     gamma* solves the pair's own contact problem;  gamma <- max(gamma + omega (gamma* - gamma), 0);  V <- V + M D
///     (change).
///
/// This converges for every symmetric positive semi-definite A and 0 < omega < 2 (Cryer 1971; Mangasarian 1977), many
/// times faster than a gradient method, because a pair's forces act on its rods at once. Pairs are coloured, so that no
/// two of one colour share a rod (PairColours): pairs of a colour can be solved by any threads in any order with the
/// same result. Contacts that push a plane share it: those of a colour are solved together (PlaneContacts).
///
/// Where a large problem has forces to begin from, what is left are the slow modes of a crowd. If the tolerance is not
/// fine, sweeps over all contacts are then not over-relaxed, but carried on by momentum (SweepMomentum), unless that
/// fails (decision 0053), or a plane is pushed.
///
/// Else only contacts that push, or are about to, take part in most sweeps (BlockGaussSeidel). Before the result is
/// called solved, forces and velocities are computed anew from gamma, and the residual over all contacts from them. It
/// stops at a candidate now and then while sweeps go on, and at every solution. The outcome's iterations are sweeps.
///
/// Sweeps begin in float where that is fine enough for the tolerance; double takes over where it is not.
class ProjectedSor final : public ContactSolver {
public:
    ProjectedSor(const ContactProblem& problem, const LcpSettings& settings);
    ~ProjectedSor() override;
    bool run_to_next_stop() override;
    void begin_again(double tolerance) override;

private:
    template <class Real>
    class Sweeps;

    double deepest_overlap() const;
    bool is_fine_enough_in_float(double overlap) const;
    std::size_t pushing_at_start() const;

    std::unique_ptr<Sweeps<float>> in_float_;
    std::unique_ptr<Sweeps<double>> in_double_;
    bool may_have_momentum_ = false;
};

}  // namespace jostle
