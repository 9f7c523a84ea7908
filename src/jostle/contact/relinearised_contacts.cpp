#include "jostle/contact/relinearised_contacts.hpp"

#include <algorithm>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

Contacts relinearised_contacts(const Contacts& contacts, const Box& box, const EndConfiguration& end,
                               double max_overlap) {
    std::vector<std::uint8_t> overlaps(contacts.size(), 0);
    parallel_for(contacts.size(), [&](std::size_t l) {
        const PairKey key = pair_of(contacts, l);
        if (is_fixed(key.i) || (l > 0 && key == pair_of(contacts, l - 1))) return;
        const PairGeometry pair = end.pair(box, key);
        overlaps[l] = gap_of_contact(contacts.contact[l], ContactFeature::nearest, pair) < -max_overlap ? 1 : 0;
    });
    std::vector<std::pair<PairKey, std::size_t>> first;  // of the contacts of each
    for (std::size_t l = 0; l < overlaps.size(); ++l)
        if (overlaps[l] == 1) first.emplace_back(pair_of(contacts, l), l);
    std::sort(first.begin(), first.end());
    first.erase(
        std::unique(first.begin(), first.end(), [](const auto& a, const auto& b) { return a.first == b.first; }),
        first.end());

    Contacts found;
    for (const auto& [key, l] : first) {
        const PairGeometry pair = end.pair(box, key);
        const PairGeometry before =
            pair_geometry(end.rods(), key.i, key.j, box.displacement(key.image), end.rods().centre, end.rods().axis);
        if (const auto contact = relinearised_contact(contacts.contact[l], before, pair))
            found.push_back(*contact, key.image, ContactFeature::relinearised);
    }
    return found;
}

}  // namespace jostle
