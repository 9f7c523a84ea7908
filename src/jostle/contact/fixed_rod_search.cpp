#include "jostle/contact/fixed_rod_search.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

PairKey key_of(const FixedCopy& copy, std::uint32_t row) {
    return {body_of_fixed_rod(copy.number), row, copy.image};
}

/// Whether a pair's middle points are farther apart than it could touch from.
bool are_apart(const PairGeometry& pair, double range) {
    const double farthest = pair.half_i + pair.half_j + pair.radii + range;
    return squared_norm(pair.centre_separation) > farthest * farthest;
}

}  // namespace

double FixedRodSearch::find(const StepGeometry& step, Contacts& contacts) {
    known_.clear();
    if (!step.box.fixed_rods()) return 0.0;
    const std::size_t count = step.rods.size();
    interaction_range_.resize(count);
    parallel_for(count, [&](std::size_t i) {
        interaction_range_[i] = step.displacement[i] + std::max(step.ranges.activation_margin, step.ranges.range);
    });
    grid_.fit(step.box, range_from_centre(step.rods, *step.box.fixed_rods(), interaction_range_));
    const std::size_t first = contacts.size();
    const double overlap = append_found(step.own_rods(), blocks_, contacts, [&](std::size_t row, FoundContacts& found) {
        search(static_cast<std::uint32_t>(row), step, found);
    });
    remember(contacts, first);
    return overlap;
}

void FixedRodSearch::search(std::uint32_t row, const StepGeometry& step, FoundContacts& found) const {
    const Rods& rods = step.rods;
    for (const FixedCopy& copy : grid_.near(rods.centre[row])) {
        const PairGeometry before = grid_.pair(copy, rods, row, rods.centre[row], rods.axis[row]);
        if (are_apart(before, interaction_range_[row])) continue;
        const NearestPoints nearest = nearest_points(before);
        const double gap = norm(nearest.separation) - before.radii;
        if (gap >= interaction_range_[row]) continue;
        found.overlap = std::max(found.overlap, -gap);
        const PairGeometry after = grid_.pair(copy, rods, row, step.known.centre[row], step.known.axis[row]);
        const NearestPoints nearest_after = nearest_points(after);
        const bool passed_through = dot(nearest.separation, nearest_after.separation) <= 0.0;
        const double gap_after = norm(nearest_after.separation) - after.radii;
        if (gap < step.ranges.range || passed_through || gap_after < step.ranges.activation_margin)
            append(copy, row, before, nearest, after, step, found.contacts);
    }
}

/// Appends the contacts of a pair.
void FixedRodSearch::append(const FixedCopy& copy, std::uint32_t row, const PairGeometry& before,
                            const NearestPoints& nearest, const PairGeometry& after, const StepGeometry& step,
                            Contacts& contacts) const {
    append_moving_contacts(key_of(copy, row), {before, nearest, after, step.normals_after}, interaction_range_[row], 3,
                           contacts);
}

void FixedRodSearch::remember(const Contacts& contacts, std::size_t first) {
    for (std::size_t l = first; l < contacts.size(); ++l)
        known_.push_back({contacts.contact[l].j, number_of_fixed_rod(contacts.contact[l].i), contacts.image[l]});
    std::sort(known_.begin(), known_.end());
}

Contacts FixedRodSearch::violated(const StepGeometry& step, const EndConfiguration& end) {
    Contacts all;
    if (!step.box.fixed_rods()) return all;
    const std::size_t count = end.rows().size();
    const double farthest =
        parallel_max(count, 0.0, [&](std::size_t k) { return static_cast<double>(end.displacements()[k].farthest); });
    grid_.fit(step.box, range_from_centre(step.rods, *step.box.fixed_rods(), interaction_range_) + farthest);
    append_found(count, blocks_, all, [&](std::size_t k, FoundContacts& found) {
        if (end.rows()[k] < step.own)
            search_again(end.rows()[k], end.displacements()[k].farthest, step, end, found.contacts);
    });
    remember(all, 0);
    return all;
}

void FixedRodSearch::search_again(std::uint32_t row, double farthest, const StepGeometry& step,
                                  const EndConfiguration& end, Contacts& found) const {
    const Rods& rods = step.rods;
    for (const FixedCopy& copy : grid_.near(rods.centre[row])) {
        const PairGeometry after = grid_.pair(copy, rods, row, step.known.centre[row], step.known.axis[row]);
        if (are_apart(after, farthest)) continue;
        if (std::binary_search(known_.begin(), known_.end(), Known{row, copy.number, copy.image})) continue;
        const PairGeometry at_end = grid_.pair(copy, rods, row, end.centre(row), end.axis(row));
        if (!pair_overlaps(at_end)) continue;
        const PairGeometry before = grid_.pair(copy, rods, row, rods.centre[row], rods.axis[row]);
        append(copy, row, before, nearest_points(before), after, step, found);
    }
}

double append_fixed_rod_contacts(const Rods& rods, const Box& box, std::span<const double> range, Contacts& contacts) {
    if (!box.fixed_rods()) return 0.0;
    FixedRodGrid grid;
    grid.fit(box, range_from_centre(rods, *box.fixed_rods(), range));
    double overlap = 0.0;
    for (std::uint32_t row = 0; row < rods.size(); ++row)
        for (const FixedCopy& copy : grid.near(rods.centre[row])) {
            const PairGeometry pair = grid.pair(copy, rods, row, rods.centre[row], rods.axis[row]);
            if (are_apart(pair, range[row])) continue;
            const NearestPoints nearest = nearest_points(pair);
            const double gap = norm(nearest.separation) - pair.radii;
            overlap = std::max(overlap, -gap);
            if (gap < range[row])
                append_contacts(key_of(copy, row), pair, nearest, norm(nearest.separation), range[row], 3, contacts);
        }
    return overlap;
}

double overlap_with_fixed_rods(const FixedRodGrid& grid, const Vec3& centre, const Vec3& axis, double length,
                               double diameter) {
    double overlap = -std::numeric_limits<double>::infinity();
    if (grid.empty()) return overlap;
    const Rods& fixed = grid.fixed();
    for (const FixedCopy& copy : grid.near(centre)) {
        const std::uint32_t f = copy.number;
        const PairGeometry pair = {centre - copy.centre,  fixed.axis[f], axis,
                                   0.5 * fixed.length[f], 0.5 * length,  0.5 * (fixed.diameter[f] + diameter)};
        if (!are_apart(pair, 0.0)) overlap = std::max(overlap, -pair_gap(pair));
    }
    return overlap;
}

Contacts relinearised_fixed_rod_contacts(const Contacts& contacts, const Box& box, const EndConfiguration& end,
                                         double max_overlap) {
    Contacts found;
    std::set<PairKey> looked_at;
    for (std::size_t l = 0; l < contacts.size() && box.fixed_rods(); ++l) {
        const Contact& known = contacts.contact[l];
        if (!is_fixed_rod(known.i) || !looked_at.insert(pair_of(contacts, l)).second) continue;
        const FixedCopy copy = copy_of(known, contacts.image[l], box);
        const Rods &fixed = *box.fixed_rods(), &rods = end.rods();
        const PairGeometry pair = pair_with(fixed, copy, rods, known.j, end.centre(known.j), end.axis(known.j));
        const PairGeometry before = pair_with(fixed, copy, rods, known.j, rods.centre[known.j], rods.axis[known.j]);
        const auto contact = relinearised_contact(known, before, pair);
        if (contact && contact->gap_after < -max_overlap)
            found.push_back(*contact, contacts.image[l], ContactFeature::relinearised);
    }
    return found;
}

}  // namespace jostle
