#include "jostle/contact/wall_contacts.hpp"

#include <algorithm>

namespace jostle {

Contact contact_with_wall(const Wall& wall, const Rods& rods, std::uint32_t row, double arm) {
    const Vec3 end = rods.centre[row] + arm * rods.axis[row];
    Contact contact;
    contact.i = wall.body();
    contact.j = row;
    contact.normal = wall.inwards(end);
    contact.arm_j = arm;
    contact.gap = contact.gap_after = wall.gap(end, rods.diameter[row]);
    return contact;
}

double append_wall_contacts(const Rods& rods, const Box& box, std::span<const double> ranges, Contacts& contacts) {
    const std::vector<Wall> walls = walls_of(box);
    if (walls.empty()) return 0.0;
    double overlap = 0.0;
    for (std::uint32_t row = 0; row < rods.size(); ++row)
        for (const Wall& wall : walls)
            for (const double arm : wall_arms(box.walls(), rods.length[row])) {
                const Contact contact = contact_with_wall(wall, rods, row, arm);
                overlap = std::max(overlap, -contact.gap);
                if (contact.gap < ranges[row]) contacts.push_back(contact, {0, 0, 0}, ContactFeature::end_of_j);
            }
    return overlap;
}

Contacts relinearised_wall_contacts(const Contacts& contacts, const Box& box, const EndConfiguration& end,
                                    double max_overlap) {
    Contacts found;
    const std::vector<Wall> walls = walls_of(box);
    for (std::size_t l = 0; l < contacts.size() && !walls.empty(); ++l) {
        Contact contact = contacts.contact[l];
        if (!is_wall(contact.i) || contacts.feature[l] == ContactFeature::relinearised) continue;
        const Wall& wall = wall_of_body(walls, contact.i);
        const Vec3 point = end.centre(contact.j) + contact.arm_j * end.axis(contact.j);
        contact.gap_after = wall.gap(point, end.rods().diameter[contact.j]);
        if (!(contact.gap_after < -max_overlap)) continue;
        contact.normal = wall.inwards(point);
        found.push_back(contact, {0, 0, 0}, ContactFeature::relinearised);
    }
    return found;
}

}  // namespace jostle
