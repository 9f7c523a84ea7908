#include "jostle/contact/collision_search.hpp"

#include <algorithm>
#include <cmath>

#include "jostle/contact/own_image.hpp"
#include "jostle/contact/segment_separation.hpp"
#include "jostle/math/vectorised.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

/// What float rounding may do to the quick bounds, in units of the rods' size. The bound of a plane is right for any
/// normal, so rounding of the nearest points does not matter to it; to the gap it does, for nearly parallel rods.
constexpr float bound_error = 1e-5F, gap_error = 2e-3F;

/// Components of normals are kept to this: each is cut by less, the whole normal by less than twice as much.
constexpr float normal_unit = 1.0F / 32766.0F;

std::int16_t in_normal_units(float component) {
    return static_cast<std::int16_t>(component * (1.0F / normal_unit));
}

/// What a pair's touching is at most.
double most_touching(const Touching& touching, const PairName& name) {
    const double i = touching.part[name.i], j = touching.part[name.j];
    return name.i == name.j ? 2.0 * i : std::sqrt(i * i + j * j);
}

/// Pairs side by side, for vector instructions.
struct Batch {
    static constexpr std::size_t size = 128;  ///< few enough to stay in the nearest cache
    using Row = std::array<float, size>;
    std::array<Row, 3> between, moved, axis_i, axis_j, axis_i_after, axis_j_after;
    Row half_i, half_j, radii;
    Row gap;          ///< before the step
    Row bound_after;  ///< lower bound of the gap after the known motion: the width of a slab with `normal`
    std::array<std::array<std::int16_t, size>, 3> normal;  ///< in units of normal_unit
};

/// The gaps of pairs, and the width of the empty slab between the moved rods whose faces
/// are normal to the line between the nearest points.
JOSTLE_VECTORISED void glance_at(std::size_t count, Batch& batch) {
    const auto& [x, y, z] = batch.between;
    const auto& [mx, my, mz] = batch.moved;
    const auto& [ux, uy, uz] = batch.axis_i;
    const auto& [vx, vy, vz] = batch.axis_j;
    const auto& [px, py, pz] = batch.axis_i_after;
    const auto& [qx, qy, qz] = batch.axis_j_after;
    auto& [normal_x, normal_y, normal_z] = batch.normal;
    for (std::size_t k = 0; k < count; ++k) {
        const auto [ex, ey, ez] = segment_separation({x[k], y[k], z[k]}, {ux[k], uy[k], uz[k]}, batch.half_i[k],
                                                     {vx[k], vy[k], vz[k]}, batch.half_j[k]);
        const float distance = std::sqrt(ex * ex + ey * ey + ez * ez) + 1e-30F;
        const float nx = ex / distance, ny = ey / distance, nz = ez / distance;
        normal_x[k] = in_normal_units(nx);
        normal_y[k] = in_normal_units(ny);
        normal_z[k] = in_normal_units(nz);
        batch.gap[k] = distance - batch.radii[k];
        batch.bound_after[k] = (x[k] + mx[k]) * nx + (y[k] + my[k]) * ny + (z[k] + mz[k]) * nz -
                               batch.half_i[k] * std::fabs(px[k] * nx + py[k] * ny + pz[k] * nz) -
                               batch.half_j[k] * std::fabs(qx[k] * nx + qy[k] * ny + qz[k] * nz) - batch.radii[k];
    }
}

}  // namespace

PairGeometry pair_geometry_after(const Rods& rods, const Box& box, const PairName& name, const RodAfter& after) {
    const auto [centre_i, axis_i] = after(name.i);
    const auto [centre_j, axis_j] = after(name.j);
    return {centre_j + box.displacement(name.image) - centre_i,
            axis_i,
            axis_j,
            0.5 * rods.length[name.i],
            0.5 * rods.length[name.j],
            0.5 * (rods.diameter[name.i] + rods.diameter[name.j])};
}

double CollisionSearch::find(const Rods& rods, const Box& box, const RodMotion& motion, Contacts& contacts) {
    reach_.resize(rods.size());
    glance_.resize(rods.size());
    parallel_for(rods.size(), [&](std::size_t i) {
        reach_[i] =
            std::max(motion.displacement[i] + motion.touching.part[i] + motion.push_allowance, 0.5 * motion.range);
        glance_[i] = {rods.centre[i],
                      in_float(rods.axis[i]),
                      in_float(motion.centre[i] - rods.centre[i]),
                      in_float(motion.axis[i]),
                      static_cast<float>(0.5 * rods.length[i]),
                      static_cast<float>(0.5 * rods.diameter[i]),
                      static_cast<float>(motion.touching.part[i] * motion.touching.part[i])};
    });
    neighbours_.set_travel(motion.travel);
    neighbours_.update(rods, box, reach_);
    blocks_.resize(neighbours_.block_count());
    parallel_for_parts(blocks_.size(), [&](std::size_t block) { search_block(block, rods, box, motion); });
    contacts.clear();
    contacts.append(blocks_.size(), [&](std::size_t block) -> const Contacts& { return blocks_[block].contacts; });
    first_count_ = contacts.size();
    added_.clear();
    return parallel_max(blocks_.size(), 0.0, [&](std::size_t block) { return blocks_[block].overlap; });
}

void CollisionSearch::search_block(std::size_t block, const Rods& rods, const Box& box, const RodMotion& motion) {
    thread_local Found found;
    found.contacts.clear();
    found.bystanders.clear();
    found.overlap = 0.0;
    std::array<std::uint32_t, Batch::size> rows;
    std::array<std::uint16_t, Batch::size> in_block;
    std::size_t count = 0;
    Batch batch;
    Batch::Row touching;
    const auto sort_out = [&] {
        glance_at(count, batch);
        for (std::size_t k = 0; k < count; ++k) {
            const float size = batch.half_i[k] + batch.half_j[k] + batch.radii[k];
            const float slack = batch.bound_after[k] - bound_error * size - touching[k];
            const bool clear = batch.gap[k] - gap_error * batch.radii[k] > static_cast<float>(motion.range);
            if (clear && slack >= static_cast<float>(motion.margin))
                found.bystanders.push_back(
                    {rows[k], slack, {batch.normal[0][k], batch.normal[1][k], batch.normal[2][k]}, in_block[k]});
            else
                look_closely(rows[k], name_of(block, rows[k], in_block[k], rods), in_block[k], rods, box, motion,
                             found);
        }
        count = 0;
    };
    neighbours_.for_close_pairs(block, [&](std::uint32_t row, std::size_t pair) {
        const auto& [i, j, image] = neighbours_.name(row, pair);
        const RodGlance &a = glance_[i], &b = glance_[j];
        const auto between = in_float(b.centre + box.displacement(image) - a.centre);
        rows[count] = row;
        in_block[count] = static_cast<std::uint16_t>(pair - block * NeighbourList::block_size);
        for (std::size_t k = 0; k < 3; ++k) {
            batch.between[k][count] = between[k];
            batch.moved[k][count] = b.moved[k] - a.moved[k];
            batch.axis_i[k][count] = a.axis[k];
            batch.axis_j[k][count] = b.axis[k];
            batch.axis_i_after[k][count] = a.axis_after[k];
            batch.axis_j_after[k][count] = b.axis_after[k];
        }
        batch.half_i[count] = a.half_length;
        batch.half_j[count] = b.half_length;
        batch.radii[count] = a.radius + b.radius;
        touching[count] = std::sqrt((a.squared_touching + b.squared_touching) * (i == j ? 2.0F : 1.0F));
        if (++count == Batch::size) sort_out();
    });
    sort_out();
    blocks_[block] = found;
}

void CollisionSearch::look_closely(std::uint32_t row, const PairName& name, std::uint16_t in_block, const Rods& rods,
                                   const Box& box, const RodMotion& motion, Found& found) const {
    const auto& [i, j, image] = name;
    const Vec3 displacement = box.displacement(image);
    const PairGeometry before = pair_geometry(rods, i, j, displacement, rods.centre, rods.axis);
    const NearestPoints nearest = nearest_points(before);
    const double distance = norm(nearest.separation), gap = distance - before.radii;
    found.overlap = std::max(found.overlap, -gap);

    const PairGeometry after = pair_geometry(rods, i, j, displacement, motion.centre, motion.axis);
    const NearestPoints nearest_after = nearest_points(after);
    const double distance_after = norm(nearest_after.separation), gap_after = distance_after - after.radii;
    const bool passed_through = dot(nearest.separation, nearest_after.separation) <= 0.0;
    const bool always = gap < motion.range || passed_through;
    double touching = most_touching(motion.touching, name);
    if (always || gap_after - touching < motion.margin) {
        const std::size_t known = found.contacts.size();
        touching = append(name, before, nearest, distance, after, motion, found.contacts);
        if (always || gap_after - touching < motion.margin) return;
        found.contacts.resize(known);
    }
    const double slack = gap_after - touching - 1e-6 * after.radii;
    // From the rod that the neighbour list names first to the other.
    const auto normal = in_float((row == i ? 1.0 : -1.0) / distance_after * nearest_after.separation);
    found.bystanders.push_back({row,
                                static_cast<float>(slack),
                                {in_normal_units(normal[0]), in_normal_units(normal[1]), in_normal_units(normal[2])},
                                in_block});
}

/// Appends the contacts of a pair, with their room. Returns the gap at which the first of them touches.
double CollisionSearch::append(const PairName& name, const PairGeometry& before, const NearestPoints& nearest,
                               double distance, const PairGeometry& after, const RodMotion& motion,
                               Contacts& contacts) const {
    const std::size_t first = contacts.size();
    const auto own_image =
        name.i == name.j && !motion.forces_at_start ? contact_with_own_image(name, after) : std::nullopt;
    if (own_image) {
        contacts.push_back(*own_image, name.image, ContactFeature::nearest);
        contacts.contact[first].gap = distance - before.radii;
        const double gap = motion.touching.of(*own_image);
        contacts.contact[first].room -= gap;
        return gap;
    }
    append_contacts(name, before, nearest, distance, reach_[name.i] + reach_[name.j], contacts);
    double largest = 0.0;
    for (std::size_t l = first; l < contacts.size(); ++l) {
        Contact& contact = contacts.contact[l];
        const double gap = motion.touching.of(contact);
        contact.room = gap_of_contact(contact, contacts.feature[l], after) - gap;
        largest = std::max(largest, gap);
    }
    return largest;
}

bool CollisionSearch::is_contact(const PairName& name, const Contacts& contacts) const {
    const PairName listed = in_order_of_rows(name);
    const auto pair_at = [&](std::size_t l) { return in_order_of_rows(pair_of(contacts, l)); };
    std::size_t low = 0, high = first_count_;
    while (low < high) {
        const std::size_t middle = low + (high - low) / 2;
        if (pair_at(middle) < listed)
            low = middle + 1;
        else
            high = middle;
    }
    if (low < first_count_ && pair_at(low) == listed) return true;
    return std::binary_search(added_.begin(), added_.end(), listed);
}

/// Whether pushes could use up the slack of a bystander along the normal of its slab.
bool CollisionSearch::may_meet(const Bystander& bystander, const Push& i, const Push& j) {
    const float slack = bystander.slack;
    const float farthest = i.farthest + j.farthest;
    const auto along = [&normal = bystander.normal](const std::array<float, 3>& a) {
        return normal_unit * (static_cast<float>(normal[0]) * a[0] + static_cast<float>(normal[1]) * a[1] +
                              static_cast<float>(normal[2]) * a[2]);
    };
    const float width = slack + along(j.centre) - along(i.centre) - std::fabs(along(i.end)) - std::fabs(along(j.end));
    return width < i.inaccuracy + j.inaccuracy + 2.0F * normal_unit * farthest;
}

std::vector<PairName> CollisionSearch::missed_pairs(const Rods& rods, const Box& box, const RodMotion& motion,
                                                    const Contacts& contacts, std::span<const std::uint32_t> pushed,
                                                    std::span<const Push> pushes, const RodAfter& after,
                                                    bool thorough) {
    const auto missed = [&](const PairName& name) {
        const auto& [i, j, image] = name;
        const PairGeometry pair = pair_geometry_after(rods, box, name, after);
        const double gap = pair_gap(pair);
        if (gap >= most_touching(motion.touching, name) || is_contact(name, contacts)) return false;
        const PairGeometry before = pair_geometry(rods, i, j, box.displacement(image), rods.centre, rods.axis);
        const NearestPoints nearest = nearest_points(before);
        Contacts points;
        return gap < append(name, before, nearest, norm(nearest.separation), pair, motion, points);
    };
    // Whether a pair is near enough to be among the bystanders does not depend on the history of the list if neither
    // rod is pushed beyond the allowance; the others wait for the thorough search.
    const auto within_allowance = [&](std::uint32_t row) { return pushes[row].farthest <= motion.push_allowance; };
    std::vector<std::vector<PairName>> found(blocks_.size());
    const auto look = [&](std::size_t block, const PairName& name) {
        if (!thorough && !(within_allowance(name.i) && within_allowance(name.j))) return;
        if (missed(name)) found[block].push_back(name);
    };
    if (!neighbours_.built_while_widened()) {
        // Most bystanders have more slack than any push: those are passed over by this alone, in few bytes.
        farthest_push_.resize(pushes.size());
        parallel_for(pushes.size(), [&](std::size_t i) { farthest_push_[i] = pushes[i].farthest; });
        parallel_for_parts(blocks_.size(), [&](std::size_t block) {
            for (const Bystander& bystander : blocks_[block].bystanders) {
                const std::uint32_t j = neighbours_.partner(pair_number(block, bystander.in_block));
                if (bystander.slack >= farthest_push_[bystander.i] + farthest_push_[j]) continue;
                if (may_meet(bystander, pushes[bystander.i], pushes[j]))
                    look(block, name_of(block, bystander.i, bystander.in_block, rods));
            }
        });
    }
    // Pairs that were passed over because no push was thought to go so far; and all, once the list is another one.
    std::vector<NeighbourList::Overreach> farther;
    if (thorough) {
        for (const std::uint32_t row : pushed)
            if (!within_allowance(row)) farther.push_back({row, pushes[row].farthest - motion.push_allowance});
    }
    if (!farther.empty()) neighbours_.widen(rods, box, reach_, farther);
    if (!farther.empty() || neighbours_.built_while_widened()) {
        found.resize(std::max(found.size(), neighbours_.block_count()));
        parallel_for_parts(neighbours_.block_count(), [&](std::size_t block) {
            neighbours_.for_close_pairs(block, [&](std::uint32_t i, std::size_t pair) {
                if (!neighbours_.was_close(i, pair)) look(block, in_order_of_ids(neighbours_.name(i, pair), rods.id));
            });
        });
    }
    std::vector<PairName> all;
    for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

void CollisionSearch::add(std::span<const PairName> missed, const Rods& rods, const Box& box, const RodMotion& motion,
                          Contacts& contacts) {
    for (const PairName& name : missed) {
        const auto& [i, j, image] = name;
        const Vec3 displacement = box.displacement(image);
        const PairGeometry before = pair_geometry(rods, i, j, displacement, rods.centre, rods.axis);
        const PairGeometry after = pair_geometry(rods, i, j, displacement, motion.centre, motion.axis);
        const NearestPoints nearest = nearest_points(before);
        append(name, before, nearest, norm(nearest.separation), after, motion, contacts);
        added_.push_back(in_order_of_rows(name));
    }
    std::sort(added_.begin(), added_.end());
}

}  // namespace jostle
