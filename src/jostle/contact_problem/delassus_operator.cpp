#include "jostle/contact_problem/delassus_operator.hpp"

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

DelassusOperator::DelassusOperator(const ContactMatrix& contact_matrix, const Rods& rods,
                                   const MobilityOperator& mobility, double compliance, const BoxColumn& box,
                                   std::optional<ArmAxes> axes)
    : contact_matrix_(contact_matrix),
      all_rods_(rods),
      axes_(axes.value_or(ArmAxes{rods.axis})),
      mobility_(mobility),
      compliance_(compliance),
      box_(box) {
    extend();
}

void DelassusOperator::extend() {
    const auto rows = contact_matrix_.rods();
    const std::size_t known_rods = rods_.size(), known_contacts = diagonal_.size();
    rods_.resize(rows.size());
    parallel_for(rows.size() - known_rods, [&](std::size_t k) {
        const std::size_t local = known_rods + k;
        rods_[local] = {axes_(rows[local]), mobility_.of_rod(rows[local])};
    });
    diagonal_.resize(contact_matrix_.size());
    parallel_for(diagonal_.size() - known_contacts, [&](std::size_t k) {
        const std::size_t l = known_contacts + k;
        diagonal_[l] = (1.0 + compliance_) * relative_mobility_of(l);
    });
    if (!opens_box()) return;
    column_.resize(contact_matrix_.size());
    parallel_for(diagonal_.size() - known_contacts, [&](std::size_t k) {
        const std::size_t l = known_contacts + k;
        column_[l] = column_of(contact_matrix_.contacts().contact[l]);
        diagonal_[l] += (1.0 + compliance_) * box_.mobility * column_[l] * column_[l];
    });
}

/// (D^T M D)_ll
double DelassusOperator::relative_mobility_of(std::size_t l) const {
    const auto [i, j] = contact_matrix_.rod_pairs()[l];
    const Contact& contact = contact_matrix_.contacts().contact[l];
    if (i == no_local_index) return point_mobility(rods_[j], contact.normal, contact.arm_j);
    return couples_rods() ? mobility_.relative_mobility(points_of(contact, all_rods_))
                          : relative_mobility(contact, rods_[i], rods_[j]);
}

void DelassusOperator::apply(std::span<const double> gamma, std::span<double> rates) const {
    forces_.resize(rods_.size());
    velocities_.resize(rods_.size());
    velocities(gamma, forces_, velocities_);
    const double box_rate =
        opens_box() ? box_.mobility * parallel_sum<double>(size(), [&](std::size_t l) { return column_[l] * gamma[l]; })
                    : 0.0;
    this->rates(velocities_, box_rate, gamma, rates);
}

void DelassusOperator::rates(std::span<const ContactVelocity> velocities, double box_rate,
                             std::span<const double> gamma, std::span<double> rates) const {
    contact_matrix_.apply_transpose(velocities, rates);
    if (opens_box()) parallel_for(rates.size(), [&](std::size_t l) { rates[l] += box_rate * column_[l]; });
    if (!compliant()) return;
    parallel_for(rates.size(), [&](std::size_t l) { rates[l] += compliance(l) * gamma[l]; });
}

void DelassusOperator::velocities(std::span<const double> gamma, std::span<ContactForce> forces,
                                  std::span<ContactVelocity> velocities, Reach reach) const {
    contact_matrix_.apply(gamma, forces);
    if (couples_rods()) {
        apply_coupling_mobility(forces, velocities, reach);
        return;
    }
    parallel_for(rods_.size(), [&](std::size_t local) {
        velocities[local] = velocity_of(rods_[local], forces[local].force, forces[local].moment);
    });
}

void DelassusOperator::apply_coupling_mobility(std::span<const ContactForce> forces,
                                               std::span<ContactVelocity> velocities, Reach reach) const {
    const auto rows = contact_matrix_.rods();
    Forces all_forces(all_rods_.size());
    Velocities all_velocities(all_rods_.size());
    parallel_for(rows.size(),
                 [&](std::size_t local) { set_force(forces[local], rods_[local].axis, rows[local], all_forces); });
    if (reach == Reach::all)
        mobility_.apply(all_forces, all_velocities);
    else
        mobility_.apply_near(all_forces, all_velocities);
    parallel_for(rows.size(), [&](std::size_t local) {
        velocities[local] = contact_velocity(all_velocities, rows[local], rods_[local].axis);
    });
}

}  // namespace jostle
