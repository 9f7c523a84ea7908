#include "jostle/contact_problem/previous_forces.hpp"

#include <algorithm>
#include <bit>
#include <tuple>
#include <utility>

#include "jostle/math/mixed_bits.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

PreviousForce force_of(const Contacts& contacts, std::size_t l, std::span<const std::uint64_t> ids, double gamma) {
    const Contact& contact = contacts.contact[l];
    const ContactFeature feature = contacts.feature[l];
    const bool upper = (feature == ContactFeature::end_of_i && contact.arm_i > 0.0) ||
                       (feature == ContactFeature::end_of_j && contact.arm_j > 0.0);
    return {id_of_body(contact.i, ids), ids[contact.j], feature, upper, gamma};
}

/// Forces by rods and feature: open addressing, half full at most.
class ForceTable {
public:
    explicit ForceTable(std::span<const PreviousForce> forces)
        : forces_(forces), slot_(std::bit_ceil(2 * forces.size() + 1), empty) {
        for (std::uint32_t k = 0; k < forces.size(); ++k) {
            std::uint32_t& slot = slot_[slot_of(forces[k])];
            if (slot == empty || forces[slot].gamma < forces[k].gamma) slot = k;
        }
    }

    double gamma_of(const PreviousForce& wanted) const {
        const std::uint32_t found = slot_[slot_of(wanted)];
        return found == empty ? 0.0 : forces_[found].gamma;
    }

private:
    static constexpr std::uint32_t empty = 0xFFFFFFFF;

    /// Where a force of this key is, or would be.
    std::size_t slot_of(const PreviousForce& wanted) const {
        const auto feature = static_cast<std::uint64_t>(wanted.feature);
        std::size_t slot = mixed_bits(mixed_bits(wanted.i) + wanted.j + feature) & (slot_.size() - 1);
        while (slot_[slot] != empty && key_of(forces_[slot_[slot]]) != key_of(wanted))
            slot = (slot + 1) & (slot_.size() - 1);
        return slot;
    }

    std::span<const PreviousForce> forces_;
    std::vector<std::uint32_t> slot_;
};

}  // namespace

std::vector<PreviousForce> previous_forces(const Contacts& contacts, std::span<const double> gamma,
                                           std::span<const std::uint64_t> ids) {
    std::vector<PreviousForce> forces;
    for (std::size_t l = 0; l < gamma.size(); ++l)
        if (gamma[l] > 0.0 && contacts.feature[l] != ContactFeature::relinearised)  // no step begins with those
            forces.push_back(force_of(contacts, l, ids, gamma[l]));
    return forces;
}

std::vector<double> starting_forces(const Contacts& contacts, std::span<const std::uint64_t> ids,
                                    std::span<const PreviousForce> previous) {
    if (previous.empty()) return {};
    const ForceTable table(previous);
    std::vector<double> gamma(contacts.size());
    parallel_for(gamma.size(), [&](std::size_t l) { gamma[l] = table.gamma_of(force_of(contacts, l, ids, 0.0)); });
    return gamma;
}

}  // namespace jostle
