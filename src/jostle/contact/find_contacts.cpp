#include "jostle/contact/find_contacts.hpp"

#include <algorithm>

#include "jostle/contact/fixed_rod_search.hpp"
#include "jostle/contact/pair_contacts.hpp"
#include "jostle/contact/wall_contacts.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

double find_contacts(const Rods& rods, const Box& box, const NeighbourList& neighbours, std::span<const double> ranges,
                     Contacts& contacts) {
    std::vector<Contacts> blocks(neighbours.block_count());
    std::vector<double> overlaps(blocks.size(), 0.0);
    const auto narrow_phase_of = [&](std::size_t block, const PairKey& key) {
        const auto& [i, j, image] = key;
        const PairGeometry geometry = pair_geometry(rods, i, j, box.displacement(image), rods.centre, rods.axis);
        const double range = ranges[i] + ranges[j];
        const NearestPoints nearest = nearest_points(geometry);
        const double distance = norm(nearest.separation);
        if (distance >= geometry.radii + range) return;
        append_contacts(key, geometry, nearest, distance, range, box.dimensions(), blocks[block]);
        overlaps[block] = std::max(overlaps[block], geometry.radii - distance);
    };
    parallel_for_parts(blocks.size(), [&](std::size_t block) {
        neighbours.for_close_pairs(block, [&](std::uint32_t i, std::size_t pair) {
            narrow_phase_of(block, in_order_of_ids(neighbours.key(i, pair), rods.id));
        });
    });
    contacts.clear();
    contacts.append(blocks.size(), [&](std::size_t block) -> const Contacts& { return blocks[block]; });
    const double with_walls = append_wall_contacts(rods, box, ranges, contacts);
    const double with_fixed_rods = append_fixed_rod_contacts(rods, box, ranges, contacts);
    return parallel_max(overlaps.size(), std::max(with_walls, with_fixed_rods),
                        [&](std::size_t block) { return overlaps[block]; });
}

}  // namespace jostle
