#include "jostle/contact/pushed_overlaps.hpp"

#include <algorithm>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

Contacts pushed_overlaps(const Contacts& contacts, const Rods& rods, const Box& box, const RodAfter& after,
                         double most) {
    const auto name_of = [&](std::size_t l) {
        return PairName{contacts.contact[l].i, contacts.contact[l].j, contacts.image[l]};
    };
    const auto geometry_of = [&](const PairName& name) {
        const auto [centre_i, axis_i] = after(name.i);
        const auto [centre_j, axis_j] = after(name.j);
        PairGeometry pair = pair_geometry(rods, name.i, name.j, box.displacement(name.image), rods.centre, rods.axis);
        pair.between = centre_j + box.displacement(name.image) - centre_i;
        pair.axis_i = axis_i;
        pair.axis_j = axis_j;
        return pair;
    };
    std::vector<std::uint8_t> overlaps(contacts.size(), 0);
    parallel_for(contacts.size(), [&](std::size_t l) {
        if (l > 0 && name_of(l) == name_of(l - 1)) return;
        overlaps[l] = pair_gap(geometry_of(name_of(l))) < -most ? 1 : 0;
    });
    std::vector<PairName> names;
    for (std::size_t l = 0; l < overlaps.size(); ++l)
        if (overlaps[l] == 1) names.push_back(name_of(l));
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());

    Contacts found;
    for (const PairName& name : names) {
        const PairGeometry pair = geometry_of(name);
        const NearestPoints nearest = nearest_points(pair);
        const double distance = norm(nearest.separation);
        if (!(distance > 0.0)) continue;  // the axes cross: no normal can be told
        Contact contact;
        contact.i = name.i;
        contact.j = name.j;
        contact.normal = nearest.separation / distance;
        contact.arm_i = nearest.s_i;
        contact.arm_j = nearest.s_j;
        contact.gap = contact.room = distance - pair.radii;
        found.push_back(contact, name.image, ContactFeature::pushed);
    }
    return found;
}

}  // namespace jostle
