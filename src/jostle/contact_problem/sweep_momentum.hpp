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
/// one way, and may go round in circles. Where changes do not fall there is less momentum, beta at most; where
/// that does not help, or changes grow, it is not trusted any more.
class SweepMomentum {
public:
    double beta() const { return beta_; }

    /// Contacts have been added: what was before tells nothing.
    void restart();

    /// `change`: the largest of a gap velocity in the sweep that was made; `turned_back`: it went against the last one.
    void advance(double change, bool turned_back);

    bool is_trusted() const { return growths_ < max_growths && largest_beta_ > 0.5; }

private:
    void lose_momentum();

    static constexpr double growth = 100.0;  ///< of the largest change since it was least: no single contact does that
    static constexpr int max_growths = 3;
    static constexpr int patience = 40;  ///< in sweeps without a change that is less than all before

    double theta_ = 1.0, beta_ = 0.0, largest_beta_ = 0.95;
    double least_change_ = std::numeric_limits<double>::infinity();  ///< since the last restart
    int growths_ = 0;
    double least_with_these_contacts_ = std::numeric_limits<double>::infinity();
    int sweeps_since_least_ = 0;
};

}  // namespace jostle
