#include "jostle/contact_problem/warm_start.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

bool before(const LastForce& a, const LastForce& b) {
    return std::tie(a.i, a.j, a.feature, a.upper) < std::tie(b.i, b.j, b.feature, b.upper);
}

void sort(std::vector<LastForce>& forces) {
    if (!std::is_sorted(forces.begin(), forces.end(), before)) std::stable_sort(forces.begin(), forces.end(), before);
}

ContactFeature seen_from_the_other_rod(ContactFeature feature) {
    switch (feature) {
        case ContactFeature::end_of_i:
            return ContactFeature::end_of_j;
        case ContactFeature::end_of_j:
            return ContactFeature::end_of_i;
        case ContactFeature::nearest:
        case ContactFeature::pushed:
            break;
    }
    return feature;
}

LastForce force_of(const Contacts& contacts, std::size_t l, double gamma) {
    const Contact& contact = contacts.contact[l];
    const ContactFeature feature = contacts.feature[l];
    const bool upper = (feature == ContactFeature::end_of_i && contact.arm_i > 0.0) ||
                       (feature == ContactFeature::end_of_j && contact.arm_j > 0.0);
    return {contact.i, contact.j, feature, upper, gamma};
}

}  // namespace

WarmStart::WarmStart(std::vector<LastForce> forces) : forces_(std::move(forces)) {
    sort(forces_);
}

void WarmStart::keep(const Contacts& contacts, std::span<const double> gamma) {
    forces_.clear();
    for (std::size_t l = 0; l < gamma.size(); ++l)
        if (gamma[l] > 0.0 && contacts.feature[l] != ContactFeature::pushed)  // no step begins with those
            forces_.push_back(force_of(contacts, l, gamma[l]));
    sort(forces_);  // contacts that were missed at first come last
}

void WarmStart::renumber(std::span<const std::uint32_t> new_row) {
    parallel_for(forces_.size(), [&](std::size_t k) {
        LastForce& force = forces_[k];
        force.i = new_row[force.i];
        force.j = new_row[force.j];
        if (force.i <= force.j) return;
        std::swap(force.i, force.j);
        force.feature = seen_from_the_other_rod(force.feature);
    });
    std::erase_if(forces_, [](const LastForce& force) { return force.j == no_row; });
    sort(forces_);
}

std::vector<double> WarmStart::guess(const Contacts& contacts) const {
    if (forces_.empty()) return {};
    std::vector<double> gamma(contacts.size(), 0.0);
    parallel_for(gamma.size(), [&](std::size_t l) {
        const LastForce same = force_of(contacts, l, 0.0);
        const auto found = std::lower_bound(forces_.begin(), forces_.end(), same, before);
        if (found != forces_.end() && !before(same, *found)) gamma[l] = found->gamma;
    });
    return gamma;
}

}  // namespace jostle
