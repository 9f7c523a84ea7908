#pragma once

#include <optional>

#include "jostle/contact_problem/contact_solver.hpp"
#include "jostle/contact_problem/contacts_among.hpp"

namespace jostle {

/// For mobilities that couple rods and have a near part, which costs little: the near part is solved again and again,
/// and what it leaves out is put in by one application of M each time.
///
/// With A = B + C, B of the near part, from gamma and v = A gamma + b:
///
///     gamma* solves 0 <= B gamma* + (v - B gamma)  perp  gamma* >= 0   (adaptive Barzilai-Borwein descent),
///     gamma <- gamma + t (gamma* - gamma),   t in (0, 1]: where 1/2 gamma.A gamma + b.gamma is least.
///
/// gamma* - gamma descends, as it lowers the same energy with B in the place of A, so that this converges as any
/// exact line search along such directions does. What B leaves out is smooth, and two rods that push each other are
/// hardly moved by it: few applications of M are needed (decision 0059). M is applied among the rods with contacts
/// alone, and to all of them once at every solution. It stops at a candidate once, to have violated pairs found early
/// by its near part, and at every solution. The outcome's iterations are applications of M.
class NearFirst final : public ContactSolver {
public:
    NearFirst(const ContactProblem& problem, const LcpSettings& settings);
    bool run_to_next_stop() override;
    void begin_again(double tolerance) override;

private:
    std::vector<double> rates_of_velocities() const;
    std::vector<double> rates_of_forces();
    double verified();
    bool stop_at_candidate();
    bool end(double residual);
    double residual() const;
    void improve(double residual);

    std::optional<ContactsAmong> among_;
    std::vector<double> velocity_;  ///< (contacts) A gamma + b
    bool begins_ = true, searched_early_ = false;
};

}  // namespace jostle
