#include "jostle/contact/pushed_overlaps.hpp"

#include <algorithm>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

Contacts pushed_overlaps(const Contacts& contacts, const Rods& rods, const Box& box, const RodAfter& after,
                         double most) {
    std::vector<std::uint8_t> overlaps(contacts.size(), 0);
    parallel_for(contacts.size(), [&](std::size_t l) {
        const PairName name = pair_of(contacts, l);
        if (l > 0 && name == pair_of(contacts, l - 1)) return;
        overlaps[l] = pair_gap(pair_geometry_after(rods, box, name, after)) < -most ? 1 : 0;
    });
    std::vector<PairName> names;
    for (std::size_t l = 0; l < overlaps.size(); ++l)
        if (overlaps[l] == 1) names.push_back(pair_of(contacts, l));
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());

    Contacts found;
    for (const PairName& name : names) {
        const PairGeometry pair = pair_geometry_after(rods, box, name, after);
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
