#include "jostle/contact/wca_forces.hpp"

#include "jostle/parallel/parallel_for.hpp"
#include "jostle/rods/wall.hpp"

namespace jostle {

namespace {

/// How many contacts share the potential of the pair that contact `l` belongs to: 0 if it has no part in it.
double sharers(const Contacts& contacts, std::size_t l) {
    if (is_wall(contacts.contact[l].i)) return 1.0;
    const auto same_pair = [&](std::size_t other) { return pair_of(contacts, other) == pair_of(contacts, l); };
    std::size_t first = l, last = l + 1;
    while (first > 0 && same_pair(first - 1)) --first;
    while (last < contacts.size() && same_pair(last)) ++last;
    for (std::size_t other = first; other < last; ++other)
        if (contacts.feature[other] == ContactFeature::nearest) return other == l ? 1.0 : 0.0;
    return static_cast<double>(last - first);
}

}  // namespace

std::vector<double> wca_forces(const Contacts& contacts, const Rods& rods, double energy) {
    std::vector<double> forces(contacts.size(), 0.0);
    parallel_for(forces.size(), [&](std::size_t l) {
        const Contact& contact = contacts.contact[l];
        const double share = sharers(contacts, l);
        if (share == 0.0) return;
        const double diameter = is_wall(contact.i) ? rods.diameter[contact.j] : contact_radii(contact, rods);
        forces[l] = wca_force(contact.gap + diameter, diameter, energy) / share;
    });
    return forces;
}

}  // namespace jostle
