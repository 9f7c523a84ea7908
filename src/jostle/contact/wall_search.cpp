#include "jostle/contact/wall_search.hpp"

#include <algorithm>
#include <cmath>

#include "jostle/contact/wall_contacts.hpp"

namespace jostle {

namespace {

void add(const Contact& contact, Contacts& contacts) {
    contacts.push_back(contact, {0, 0, 0}, ContactFeature::end_of_j);
}

/// Less than the gap of either end of the rod from any wall, after the known motion: from the centre, which is cheaper
/// than from each end. An end is as much nearer to a plane as the axis is inclined, and to a container at most half a
/// length.
double gap_at_least(std::span<const Wall> walls, std::uint32_t row, const StepGeometry& step) {
    const Walls& of_box = step.box.walls();
    const Vec3 &centre = step.known.centre[row], &axis = step.known.axis[row], &edges = step.box.edges();
    const double half = 0.5 * step.rods.length[row], radius = 0.5 * step.rods.diameter[row];
    double nearest = INFINITY;
    for (int k = 0; k < 3; ++k)
        if (of_box.faces[static_cast<std::size_t>(k)])
            nearest = std::min(nearest, std::min(centre[k], edges[k] - centre[k]) - half * std::fabs(axis[k]));
    if (of_box.container != Container::none) nearest = std::min(nearest, walls.back().distance(centre) - half);
    const double rounding = 1e-9 * (half + radius);
    return nearest - radius - rounding;
}

/// The point at `arm` of a rod after the known motion.
Vec3 known_point(std::uint32_t row, double arm, const StepGeometry& step) {
    return step.known.centre[row] + arm * step.known.axis[row];
}

/// The contact of that point with a wall.
Contact contact_of_step(const Wall& wall, std::uint32_t row, double arm, const StepGeometry& step) {
    Contact contact = contact_with_wall(wall, step.rods, row, arm);
    const Vec3 before = step.rods.centre[row] + arm * step.rods.axis[row];
    const Vec3 after = known_point(row, arm, step);
    contact.normal = wall.inwards(before + step.normals_after * (after - before));
    contact.gap_after = wall.gap(after, step.rods.diameter[row]);
    return contact;
}

}  // namespace

double WallSearch::find(const StepGeometry& step, Contacts& contacts) {
    walls_ = walls_of(step.box);
    if (walls_.empty()) return 0.0;
    const std::size_t count = step.own_rods();
    known_.assign(count, 0);
    gap_at_least_.resize(count);
    return append_found(count, blocks_, contacts, [&](std::size_t row, FoundContacts& found) {
        search(static_cast<std::uint32_t>(row), step, found);
    });
}

void WallSearch::search(std::uint32_t row, const StepGeometry& step, FoundContacts& found) {
    const Rods& rods = step.rods;
    const double range = std::max(step.ranges.activation_margin, step.ranges.range);
    gap_at_least_[row] = gap_at_least(walls_, row, step);
    if (gap_at_least_[row] > range + step.displacement[row]) return;
    for (const Wall& wall : walls_) {
        for (const double arm : wall_arms(step.box.walls(), rods.length[row])) {
            const double after = wall.gap(known_point(row, arm, step), rods.diameter[row]);
            if (after - step.displacement[row] > range) continue;
            const Contact contact = contact_of_step(wall, row, arm, step);
            found.overlap = std::max(found.overlap, -contact.gap);
            if (contact.gap >= step.ranges.range && contact.gap_after >= step.ranges.activation_margin) continue;
            known_[row] = static_cast<std::uint16_t>(known_[row] | 1U << bit_of(wall, arm));
            add(contact, found.contacts);
        }
    }
}

Contacts WallSearch::violated(const StepGeometry& step, const EndConfiguration& end) {
    Contacts all;
    if (walls_.empty()) return all;
    append_found(end.rows().size(), blocks_, all, [&](std::size_t k, FoundContacts& found) {
        const std::uint32_t row = end.rows()[k];
        const double farthest = end.displacements()[k].farthest;
        if (row < step.own && gap_at_least_[row] <= farthest) search_again(row, farthest, step, end, found.contacts);
    });
    return all;
}

void WallSearch::search_again(std::uint32_t row, double farthest, const StepGeometry& step, const EndConfiguration& end,
                              Contacts& found) {
    const Rods& rods = step.rods;
    for (const Wall& wall : walls_) {
        for (const double arm : wall_arms(step.box.walls(), rods.length[row])) {
            const double after = wall.gap(known_point(row, arm, step), rods.diameter[row]);
            if (after > farthest || is_contact(row, wall, arm)) continue;
            const double at_end = wall.gap(end.centre(row) + arm * end.axis(row), rods.diameter[row]);
            if (at_end >= 0.0) continue;
            known_[row] = static_cast<std::uint16_t>(known_[row] | 1U << bit_of(wall, arm));
            add(contact_of_step(wall, row, arm, step), found);
        }
    }
}

}  // namespace jostle
