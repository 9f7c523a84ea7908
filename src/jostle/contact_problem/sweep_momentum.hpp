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
///
/// As a last resort, where sweeps without it do not get on, there is no less of it: beta may come near 1, so that of
/// forces that nearly balance each other (eigenvalues lambda of A far below A_ll) the number of sweeps grows as
/// 1/sqrt(lambda), and not as 1/lambda. Where changes do not fall it begins anew; where they grow it rests for some
/// sweeps, which lower the energy.
class SweepMomentum {
public:
    enum class Use { for_speed, as_last_resort };
    explicit SweepMomentum(Use use = Use::for_speed)
        : use_(use), largest_beta_(use == Use::for_speed ? 0.95 : 0.9999) {}

    double beta() const { return beta_; }

    /// Contacts have been added: what was before tells nothing.
    void restart();

    /// `change`: the largest of a gap velocity in the sweep that was made; `turned_back`: it went against the last one.
    void advance(double change, bool turned_back);

    /// To be told of each sweep without momentum.
    void rest() { rests_ = rests_ > 0 ? rests_ - 1 : 0; }

    bool is_trusted() const { return growths_ < max_growths && largest_beta_ > 0.5 && rests_ == 0; }

private:
    void lose_momentum();

    static constexpr double growth = 100.0;  ///< of the largest change since it was least: no single contact does that
    static constexpr int max_growths = 3;
    /// In sweeps without a change that is less than all before; and as a last resort.
    static constexpr int patience = 40, last_patience = 1000;
    static constexpr int sweeps_of_rest = 50;

    Use use_;
    double theta_ = 1.0, beta_ = 0.0, largest_beta_;
    double least_change_ = std::numeric_limits<double>::infinity();  ///< since the last restart
    int growths_ = 0, rests_ = 0;
    double least_with_these_contacts_ = std::numeric_limits<double>::infinity();
    int sweeps_since_least_ = 0;
};

}  // namespace jostle
