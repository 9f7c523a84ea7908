#pragma once

#include <optional>

#include "jostle/contact/contact_matrix.hpp"
#include "jostle/contact_problem/box_column.hpp"
#include "jostle/lcp/linear_operator.hpp"
#include "jostle/mobility/mobility.hpp"

namespace jostle {

/// A = D^T M D (theory, eq. 2.4): gap velocities caused by contact forces. The place where contact and mobility meet.
///
/// With a compliance kappa it is D^T M D + kappa diag(D^T M D) (theory, eq. 3.9): positive definite. Never formed: one
/// application is a gather over the rods that have contacts, the mobility, and a pass over contacts. A box that opens
/// is one more body: D^T M D then has the square of its column. Holds references.
class DelassusOperator final : public LinearOperator {
public:
    /// `axes`: of the rods; by default as they lie.
    DelassusOperator(const ContactMatrix& contact_matrix, const Rods& rods, const MobilityOperator& mobility,
                     double compliance = 0.0, const BoxColumn& box = {}, std::optional<ArmAxes> axes = std::nullopt);

    /// Takes in what the contact matrix has been extended by.
    void extend();

    std::size_t size() const override { return contact_matrix_.size(); }
    void apply(std::span<const double> gamma, std::span<double> rates) const override;

    /// A_ll, compliance included.
    std::span<const double> diagonal() const override { return diagonal_; }

    /// kappa (D^T M D)_ll
    double compliance(std::size_t l) const { return compliance_ * (diagonal_[l] / (1.0 + compliance_)); }
    bool compliant() const { return compliance_ > 0.0; }

    const ContactMatrix& contact_matrix() const { return contact_matrix_; }

    std::span<const MobileRod> rods() const { return rods_; }  ///< (n) those with contacts
    bool couples_rods() const { return mobility_.couples_rods(); }
    const MobilityOperator& mobility() const { return mobility_; }
    bool opens_box() const { return box_.mobility > 0.0; }
    /// How much faster the gap of a contact opens than the box does (BoxColumn).
    double column_of(const Contact& contact) const { return box_.of(contact, all_rods_, axes_); }
    const BoxColumn& box() const { return box_; }
    double column(std::size_t l) const { return column_[l]; }  ///< w, where the box opens

    /// A gamma, from M D gamma and the rate of the box, m w.gamma.
    void rates(std::span<const ContactVelocity> velocities, double box_rate, std::span<const double> gamma,
               std::span<double> rates) const;

    /// What of the mobility is applied: all of it, or only its near part.
    enum class Reach { all, near };

    /// D gamma and M D gamma, one a rod with contacts.
    void velocities(std::span<const double> gamma, std::span<ContactForce> forces,
                    std::span<ContactVelocity> velocities, Reach reach = Reach::all) const;

private:
    double relative_mobility_of(std::size_t l) const;
    void apply_coupling_mobility(std::span<const ContactForce> forces, std::span<ContactVelocity> velocities,
                                 Reach reach) const;

    const ContactMatrix& contact_matrix_;
    const Rods& all_rods_;
    ArmAxes axes_;
    const MobilityOperator& mobility_;
    double compliance_;
    BoxColumn box_;
    std::vector<MobileRod> rods_;
    std::vector<double> diagonal_;
    std::vector<double> column_;                       ///< (contacts) w; (0) where the box stays
    mutable std::vector<ContactForce> forces_;         ///< (n) scratch
    mutable std::vector<ContactVelocity> velocities_;  ///< (n) scratch
};

/// The answer of one rod that feels its own drag only: U = [parallel n n + perpendicular (I - n n)] F, and W = Omega x
/// n = rotational (I - n n) moment.
inline ContactVelocity velocity_of(const MobileRod& rod, const Vec3& force, const Vec3& moment) {
    const RodMobility& m = rod.mobility;
    return {m.perpendicular * force + ((m.parallel - m.perpendicular) * dot(rod.axis, force)) * rod.axis,
            m.rotational * (moment - dot(rod.axis, moment) * rod.axis)};
}

}  // namespace jostle
