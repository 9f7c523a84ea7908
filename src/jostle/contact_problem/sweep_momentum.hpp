#pragma once

#include <limits>

namespace jostle {

/// How far sweeps over the contacts are carried on by what the last sweep changed: Nesterov's momentum, restarted.
///
///     y = x_k + beta (x_k - x_{k-1}),   x_{k+1}: a Gauss-Seidel sweep from y,
///     theta_{k+1} = (1 + sqrt(1 + 4 theta_k^2))/2,   beta_{k+1} = (theta_k - 1)/theta_{k+1}
///
/// (Y. Nesterov, Sov. Math. Dokl. 27, 372 (1983)), and from theta = 1 anew where a sweep turns back what the last one
/// did (B. O'Donoghue, E. Candes, Found. Comput. Math. 15, 715 (2015)). Their proofs are for symmetric sweeps; these go
/// one way, so growing changes are watched, and after some the momentum is not trusted any more.
class SweepMomentum {
public:
    double beta() const { return beta_; }

    /// Forgets what was: contacts have been added.
    void restart();

    /// `change`: the largest of a gap velocity in the sweep that was made; `turned_back`: it went against the last one.
    void advance(double change, bool turned_back);

    bool is_trusted() const { return growths_ < max_growths; }

private:
    static constexpr double largest_beta = 0.95;
    static constexpr double growth = 100.0;  ///< of the largest change since it was least: no single contact does that
    static constexpr int max_growths = 3;

    double theta_ = 1.0, beta_ = 0.0;
    double least_change_ = std::numeric_limits<double>::infinity();  ///< since the last restart
    int growths_ = 0;
};

}  // namespace jostle
