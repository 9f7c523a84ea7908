#include "jostle/contact/gaps_at.hpp"

#include "jostle/contact/fixed_rod_grid.hpp"
#include "jostle/contact/own_image.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

std::vector<double> gaps_at(const Contacts& contacts, const Box& box, const EndConfiguration& there) {
    const std::vector<Wall> walls = walls_of(box);
    std::vector<double> gaps(contacts.size());
    parallel_for(gaps.size(), [&](std::size_t l) {
        const Contact& contact = contacts.contact[l];
        if (is_wall(contact.i)) {
            const Vec3 point = there.centre(contact.j) + contact.arm_j * there.axis(contact.j);
            gaps[l] = wall_of_body(walls, contact.i).gap(point, there.rods().diameter[contact.j]);
            return;
        }
        const PairGeometry pair =
            is_fixed(contact.i) ? pair_with(*box.fixed_rods(), copy_of(contact, contacts.image[l], box), there.rods(),
                                            contact.j, there.centre(contact.j), there.axis(contact.j))
                                : there.pair(box, pair_of(contacts, l));
        const auto own_image =
            contact.i == contact.j ? contact_with_own_image(pair_of(contacts, l), pair) : std::nullopt;
        gaps[l] = own_image ? own_image->gap_after : gap_of_contact(contact, contacts.feature[l], pair);
    });
    return gaps;
}

}  // namespace jostle
