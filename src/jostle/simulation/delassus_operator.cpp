#include "jostle/simulation/delassus_operator.hpp"

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

/// normal.(velocity of the rod's point at `arm`) for a unit force along `normal` at that point.
double point_mobility(const RodMobility& rod, const Vec3& axis, const Vec3& normal, double arm) {
    const double along = dot(normal, axis);
    const double across_squared = squared_norm(normal) - along * along;
    return rod.parallel * along * along + (rod.perpendicular + arm * arm * rod.rotational) * across_squared;
}

double diagonal_element(const Contact& contact, const Rods& rods, const Mobility& mobility) {
    const RodMobility mobility_i = mobility.of_rod(contact.i);
    if (contact.i == contact.j) {  // own image: the centre stays, only turning opens the gap
        const Vec3& axis = rods.axis[contact.i];
        const double along = dot(contact.normal, axis);
        const double lever = contact.arm_j - contact.arm_i;
        return lever * lever * mobility_i.rotational * (squared_norm(contact.normal) - along * along);
    }
    return point_mobility(mobility_i, rods.axis[contact.i], contact.normal, contact.arm_i) +
           point_mobility(mobility.of_rod(contact.j), rods.axis[contact.j], contact.normal, contact.arm_j);
}

}  // namespace

DelassusOperator::DelassusOperator(const ContactMatrix& contact_matrix, const Mobility& mobility)
    : contact_matrix_(contact_matrix),
      mobility_(mobility),
      diagonal_(contact_matrix.contact_count()),
      forces_(contact_matrix.rods().size()),
      velocities_(contact_matrix.rods().size()) {
    const auto& contacts = contact_matrix.contacts().contact;
    parallel_for(contacts.size(),
                 [&](std::size_t l) { diagonal_[l] = diagonal_element(contacts[l], contact_matrix.rods(), mobility); });
}

void DelassusOperator::apply(std::span<const double> gamma, std::span<double> rates) const {
    velocities(gamma, forces_, velocities_);
    contact_matrix_.apply_transpose(velocities_, rates);
}

void DelassusOperator::velocities(std::span<const double> gamma, Forces& forces, Velocities& velocities) const {
    contact_matrix_.apply(gamma, forces);
    mobility_.apply(contact_matrix_.rods(), forces, velocities);
}

}  // namespace jostle
