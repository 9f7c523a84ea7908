#pragma once

#include <array>
#include <cstddef>

#include "jostle/lcp/lcp_problem.hpp"

namespace jostle {

/// A candidate solution of a contact problem.
struct LcpIterate {
    std::vector<double> gamma;
    std::vector<double> velocity;  ///< A gamma + b
    double residual = 0.0;         ///< lcp_residual of the settings' kind
};

/// What the solvers share: the current iterate, room for the next one, the best one so far, and a count of the
/// applications of A.
///
/// The three iterates change places and are never copied. A solver fills `next()`, calls `advance()`, and goes on while
/// the search is `unsolved()`.
class LcpSearch {
public:
    /// The first iterate is `start` (>= 0, one number a contact), at the cost of one application, or zero if it is
    /// empty.
    LcpSearch(const LcpProblem& problem, const LcpSettings& settings, std::span<const double> start);

    /// Whether the current iterate is finite and above the tolerance, and A may be applied once more.
    bool unsolved() const;
    std::uint64_t applications() const { return applications_; }  ///< of A, so far
    std::uint64_t applications_left() const;                      ///< none once the search is interrupted

    /// image = A x, counted.
    void apply(std::span<const double> x, std::span<double> image);
    /// Fills the velocity of `next()` from its gamma, by one application.
    void apply_to_next();

    const LcpProblem& problem() const { return problem_; }
    const LcpIterate& current() const { return iterates_[current_]; }
    LcpIterate& next() { return iterates_[next_]; }

    /// Measures the residual of `next()`, whose gamma and velocity are filled in, and makes it the current iterate.
    void advance();

    /// Whether the residual of `next()` is below half of the best one so far.
    bool next_halves_best() const;

    /// Whether a short step should be taken now. Gradient methods that are not monotone can run in circles: after 20
    /// iterates without a new best residual this is true for every second one, until there is one.
    bool circling() const;

    /// The current iterate if it solves the problem, else the best one; with the status that the current one amounts
    /// to, because it is the current one that runs off where there is no solution. Leaves the search empty.
    LcpResult result();

private:
    const LcpProblem& problem_;
    const LcpSettings& settings_;
    std::array<LcpIterate, 3> iterates_;
    std::size_t current_ = 0, next_ = 1, best_ = 0;
    std::uint64_t applications_ = 0;
    bool interrupted_ = false;
    std::uint64_t since_best_ = 0;  ///< iterates
};

/// s.s, s.y, y.y of the last step s of gamma and y of the gradient, in the solver's own scaling.
struct StepProducts {
    double ss = 0.0, sy = 0.0, yy = 0.0;
    StepProducts& operator+=(const StepProducts& other) {
        ss += other.ss;
        sy += other.sy;
        yy += other.yy;
        return *this;
    }
};

/// 1/A_ll: scaled by it, contacts of rods of any size weigh alike (Jacobi). Where A_ll = 0, which also means a row and
/// column of zeros, the smallest of the others stands in for it, or 1.
std::vector<double> inverse_diagonal(const LinearOperator& matrix);

/// The step length alpha with which gamma - alpha W velocity, W = diag(weight), has the least energy along the
/// projected gradient: contacts that are apart and without force are left out. `weight` empty is W = 1.
///
/// Costs one application. Where the energy falls without end, 1 over the largest element of W diag(A).
double first_step_length(LcpSearch& search, std::span<const double> weight);

}  // namespace jostle
