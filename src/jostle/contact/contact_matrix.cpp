#include "jostle/contact/contact_matrix.hpp"

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

ContactMatrix::ContactMatrix(const Contacts& contacts, const Rods& rods)
    : contacts_(contacts),
      rods_(rods),
      begin_(rods.size() + 1, 0),
      sides_(2 * contacts.size()),
      tip_velocity_(rods.size()) {
    for (const Contact& contact : contacts.contact) {
        ++begin_[contact.i + 1];
        ++begin_[contact.j + 1];
    }
    for (std::size_t k = 0; k < rods.size(); ++k) begin_[k + 1] += begin_[k];
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t l = 0; l < contacts.size(); ++l) {
        const auto side = static_cast<std::uint32_t>(2 * l);
        sides_[next[contacts.contact[l].i]++] = side;
        sides_[next[contacts.contact[l].j]++] = side + 1;
    }
}

void ContactMatrix::apply(std::span<const double> gamma, Forces& forces) const {
    parallel_for(rods_.size(), [&](std::size_t k) {
        Vec3 force, lever;  // lever: sum of arm * force, so that torque = axis x lever
        for (std::uint32_t entry = begin_[k]; entry < begin_[k + 1]; ++entry) {
            const std::uint32_t side = sides_[entry];
            const Contact& contact = contacts_.contact[side / 2];
            const bool is_j = (side % 2) == 1;
            const Vec3 push = (is_j ? gamma[side / 2] : -gamma[side / 2]) * contact.normal;
            force += push;
            lever += (is_j ? contact.arm_j : contact.arm_i) * push;
        }
        forces.force[k] = force;
        forces.torque[k] = cross(rods_.axis[k], lever);
    });
}

void ContactMatrix::apply_transpose(const Velocities& velocities, std::span<double> rates) const {
    parallel_for(rods_.size(), [&](std::size_t k) { tip_velocity_[k] = cross(velocities.angular[k], rods_.axis[k]); });
    parallel_for(contacts_.size(), [&](std::size_t l) {
        const Contact& contact = contacts_.contact[l];
        const Vec3 of_i = velocities.linear[contact.i] + contact.arm_i * tip_velocity_[contact.i];
        const Vec3 of_j = velocities.linear[contact.j] + contact.arm_j * tip_velocity_[contact.j];
        rates[l] = dot(contact.normal, of_j - of_i);
    });
}

}  // namespace jostle
