#pragma once

#include "jostle/contact/contact_matrix.hpp"
#include "jostle/lcp/linear_operator.hpp"
#include "jostle/mobility/mobility.hpp"

namespace jostle {

/// A = D^T M D (theory, eq. 2.4): gap velocities caused by contact forces. The place where contact and mobility meet.
///
/// Never formed: one application is a gather over rods, the mobility, and a pass over contacts. Holds references.
class DelassusOperator final : public LinearOperator {
public:
    DelassusOperator(const ContactMatrix& contact_matrix, const Mobility& mobility);

    std::size_t size() const override { return contact_matrix_.contact_count(); }
    void apply(std::span<const double> gamma, std::span<double> rates) const override;

    /// A_ll of each rod's own mobility (for a mobility that couples rods, the local part of it).
    std::span<const double> diagonal() const override { return diagonal_; }

    /// The rods' velocities M D gamma.
    void velocities(std::span<const double> gamma, Forces& forces, Velocities& velocities) const;

private:
    const ContactMatrix& contact_matrix_;
    const Mobility& mobility_;
    std::vector<double> diagonal_;
    mutable Forces forces_;
    mutable Velocities velocities_;
};

}  // namespace jostle
