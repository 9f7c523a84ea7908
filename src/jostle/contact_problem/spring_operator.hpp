#pragma once

#include <span>
#include <vector>

#include "jostle/contact_problem/delassus_operator.hpp"
#include "jostle/lcp/linear_operator.hpp"

namespace jostle {

/// Compliant contacts as a linear problem of twice the size, for the methods of lcp/. Each contact rests on two springs
/// side by side: a soft one, and one that begins to push at the knee, so stiff that the two together are what is asked
/// for (theory, eq. 3.5):
///
///     [A + soft   A       ] [force of the soft one ]   [b       ]
///     [A          A + rest] [force of the stiff one] + [b + give]
///
/// Holds a reference to the matrix.
class SpringOperator final : public LinearOperator {
public:
    /// `b`: (contacts) the velocity of each gap without forces.
    SpringOperator(const DelassusOperator& matrix, std::span<const double> b);

    std::size_t size() const override { return 2 * contacts_; }
    std::span<const double> diagonal() const override { return diagonal_; }
    std::span<const double> constant() const { return constant_; }
    void apply(std::span<const double> forces, std::span<double> result) const override;

    /// (2 contacts) forces of the springs, soft ones first, from (contacts) those of the contacts; and back.
    std::vector<double> split(std::span<const double> gamma) const;
    std::vector<double> joined(std::span<const double> forces) const;

private:
    const DelassusOperator& matrix_;
    std::size_t contacts_;
    std::vector<double> constant_, diagonal_, rest_;
    mutable std::vector<double> both_, rates_;  ///< (contacts) scratch
};

}  // namespace jostle
