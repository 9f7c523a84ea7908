#include "jostle/contact_problem/contacts_among.hpp"

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

ContactsAmong::ContactsAmong(const DelassusOperator& matrix)
    : matrix_(matrix), whole_(*this, false), near_(*this, true) {
    const ContactMatrix& contacts = matrix.contact_matrix();
    std::vector<char> touches(contacts.rods().size(), 0);
    for (const auto [i, j] : contacts.rod_pairs()) {
        if (i != no_local_index) touches[i] = 1;
        touches[j] = 1;
    }
    std::vector<std::uint32_t> rows;
    for (std::uint32_t local = 0; local < touches.size(); ++local)
        if (touches[local] != 0) {
            locals_.push_back(local);
            rows.push_back(contacts.rods()[local]);
        }
    mobility_ = matrix.mobility().among(rows);
    forces_.resize(touches.size());
    velocities_.resize(touches.size());
    rod_forces_ = Forces(locals_.size());
}

void ContactsAmong::apply(bool near, std::span<const double> gamma, std::span<double> rates) const {
    matrix_.contact_matrix().apply(gamma, forces_);
    const auto axis = [&](std::size_t k) -> const Vec3& { return matrix_.rods()[locals_[k]].axis; };
    parallel_for(locals_.size(), [&](std::size_t k) { set_force(forces_[locals_[k]], axis(k), k, rod_forces_); });
    if (near)
        mobility_->apply_near(rod_forces_, rod_velocities_);
    else
        mobility_->apply(rod_forces_, rod_velocities_);
    parallel_for(locals_.size(),
                 [&](std::size_t k) { velocities_[locals_[k]] = contact_velocity(rod_velocities_, k, axis(k)); });
    matrix_.rates(velocities_, 0.0, gamma, rates);
}

}  // namespace jostle
