#include "jostle/contact/contact_matrix.hpp"

#include <algorithm>
#include <tuple>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

ContactMatrix::ContactMatrix(const Contacts& contacts, std::span<const std::uint64_t> ids, Include include,
                             std::size_t always_from)
    : contacts_(contacts), ids_(ids), local_index_(ids.size(), no_local_index) {
    if (include == Include::all_rods) {
        rows_.resize(ids.size());
        for (std::uint32_t row = 0; row < ids.size(); ++row) rows_[row] = local_index_[row] = row;
    }
    extend();
    for (std::size_t row = always_from; row < ids.size(); ++row) numbered(static_cast<std::uint32_t>(row));
}

/// The local index of a row, which it gets if it has none.
std::uint32_t ContactMatrix::numbered(std::uint32_t row) {
    if (local_index_[row] == no_local_index) {
        local_index_[row] = static_cast<std::uint32_t>(rows_.size());
        rows_.push_back(row);
    }
    return local_index_[row];
}

void ContactMatrix::extend() {
    rod_pairs_.reserve(contacts_.size());
    for (std::size_t l = rod_pairs_.size(); l < contacts_.size(); ++l) {
        const std::uint32_t body = contacts_.contact[l].i;
        const std::uint32_t i = is_fixed(body) ? no_local_index : numbered(body);
        rod_pairs_.push_back({i, numbered(contacts_.contact[l].j)});
    }
    begin_.clear();
}

void ContactMatrix::list_incidence() const {
    begin_.assign(rows_.size() + 1, 0);
    for (const RodPair& ends : rod_pairs_) {
        if (ends.i != no_local_index) ++begin_[ends.i + 1];
        ++begin_[ends.j + 1];
    }
    for (std::size_t k = 0; k < rows_.size(); ++k) begin_[k + 1] += begin_[k];
    incidence_.resize(begin_.back());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t l = 0; l < size(); ++l) {
        const auto side = static_cast<std::uint32_t>(2 * l);
        if (rod_pairs_[l].i != no_local_index) incidence_[next[rod_pairs_[l].i]++] = side;
        incidence_[next[rod_pairs_[l].j]++] = side + 1;
    }
    const auto key = [this](std::uint32_t side) {
        const std::size_t l = side / 2;
        const bool is_j = side % 2 == 1;
        const PairKey key_of_pair = pair_of(contacts_, l);
        return std::tuple(is_j ? id_of_i(l) : id_of_j(l), is_j ? key_of_pair.turned().image : key_of_pair.image, side);
    };
    parallel_for(rows_.size(), [&](std::size_t k) {
        std::sort(incidence_.begin() + begin_[k], incidence_.begin() + begin_[k + 1],
                  [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    });
}

void ContactMatrix::apply(std::span<const double> gamma, std::span<ContactForce> forces) const {
    if (begin_.empty()) list_incidence();
    parallel_for(rows_.size(), [&](std::size_t k) {
        ContactForce sum;
        for (std::uint32_t entry = begin_[k]; entry < begin_[k + 1]; ++entry) {
            const std::uint32_t side = incidence_[entry];
            const Contact& contact = contacts_.contact[side / 2];
            const bool is_j = (side % 2) == 1;
            const Vec3 force = (is_j ? gamma[side / 2] : -gamma[side / 2]) * contact.normal;
            sum.force += force;
            sum.moment += (is_j ? contact.arm_j : contact.arm_i) * force;
        }
        forces[k] = sum;
    });
}

void ContactMatrix::apply_transpose(std::span<const ContactVelocity> velocities, std::span<double> rates) const {
    parallel_for(size(), [&](std::size_t l) {
        const auto [i, j] = rod_pairs_[l];
        rates[l] =
            gap_rate(contacts_.contact[l], i == no_local_index ? ContactVelocity{} : velocities[i], velocities[j]);
    });
}

}  // namespace jostle
