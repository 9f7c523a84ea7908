#include "jostle/contact/gaps_at.hpp"

#include <algorithm>

#include "jostle/contact/fixed_rod_grid.hpp"
#include "jostle/contact/own_image.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

double gap_at_wall(const Contact& contact, std::span<const Wall> walls, const EndConfiguration& there) {
    const Wall& wall =
        *std::find_if(walls.begin(), walls.end(), [&](const Wall& one) { return one.body() == contact.i; });
    const Vec3 point = there.centre(contact.j) + contact.arm_j * there.axis(contact.j);
    return wall.distance(point) - 0.5 * there.rods.diameter[contact.j];
}

}  // namespace

std::vector<double> gaps_at(const Contacts& contacts, const Box& box, const EndConfiguration& there) {
    const std::vector<Wall> walls = walls_of(box);
    std::vector<double> gaps(contacts.size());
    parallel_for(gaps.size(), [&](std::size_t l) {
        const Contact& contact = contacts.contact[l];
        if (is_fixed(contact.i) && !is_fixed_rod(contact.i)) {
            gaps[l] = gap_at_wall(contact, walls, there);
            return;
        }
        const PairGeometry pair = is_fixed(contact.i)
                                      ? pair_with(*box.fixed_rods(), copy_of(contact, contacts.image[l], box),
                                                  there.rods, contact.j, there.centre(contact.j), there.axis(contact.j))
                                      : there.pair(box, pair_of(contacts, l));
        const auto own_image =
            contact.i == contact.j ? contact_with_own_image(pair_of(contacts, l), pair) : std::nullopt;
        gaps[l] = own_image ? own_image->gap_after : gap_of_contact(contact, contacts.feature[l], pair);
    });
    return gaps;
}

}  // namespace jostle
