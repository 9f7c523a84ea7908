#pragma once

#include <limits>

namespace jostle {

/// How far sweeps over the contacts are carried on by what the last sweep changed: Nesterov's momentum.
///
///     y = x_k + beta_k (x_k - x_{k-1}),   x_{k+1}: a Gauss-Seidel sweep from y,
///     beta_0 = 0,   beta_k = max(0.8, 1 - 8/k), at most 0.95
///
/// beta = (1 - q)/(1 + q) is best for problems whose least eigenvalue is q^2 of the largest (Y. Nesterov, Introductory
/// Lectures on Convex Optimization, Springer 2004, section 2.2). They take a number of sweeps that goes as 1/q. q is
/// not known beforehand: where many sweeps have been made, it must be small.
///
/// His proof is for symmetric sweeps; these go one way, and may go round in circles. Where changes do not fall there is
/// less momentum; where that does not help, or changes grow, it is not trusted any more.
class SweepMomentum {
public:
    double beta() const;

    /// Changes that follow may be larger than those before: contacts have been added, which have no momentum yet.
    void expect_larger_changes();

    /// `change`: the largest of a gap velocity in the sweep that was made.
    void advance(double change);

    bool is_trusted() const { return growths_ < max_growths && largest_beta_ > 0.5; }

private:
    void restart();

    static constexpr double growth = 100.0;  ///< of the largest change since it was least: no single contact does that
    static constexpr int max_growths = 3;
    static constexpr int patience = 40;  ///< in sweeps without a change that is less than all before

    double largest_beta_ = 0.95;
    int sweeps_ = 0;  ///< k
    double least_change_ = std::numeric_limits<double>::infinity();
    int sweeps_since_least_ = 0;
    int growths_ = 0;
};

}  // namespace jostle
