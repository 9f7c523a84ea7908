#include "jostle/contact/collision_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "jostle/contact/own_image.hpp"
#include "jostle/contact/pair_bounds.hpp"
#include "jostle/math/marked_numbers.hpp"
#include "jostle/math/vectorised.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

/// If not more than one of so many rods is displaced beyond the limit, their pairs are looked for one rod after the
/// other, else all pairs are passed over.
constexpr std::size_t rods_per_one_beyond = 12;

/// By so many displacement limits a rod that comes beyond the limit may go on before it is looked at again.
constexpr double foresight = 0.25;

/// What is left of the gaps of pairs whose rods have gone so far, rounding apart. Marks those that have nothing left.
JOSTLE_VECTORISED void take_off_changes(std::size_t count, const std::uint32_t* i, const std::uint32_t* j,
                                        const float* change, float* left, std::uint8_t* marks) {
    for (std::size_t k = 0; k < count; ++k) left[k] = left[k] * (1.0F - 1e-6F) - (change[i[k]] + change[j[k]]);
    for (std::size_t k = 0; k < count; ++k) marks[k] = left[k] > 0.0F ? 0 : 1;
}

/// How far forces take any point of a rod beyond where they took it at the last search, at most. Of two rotations the
/// ends of a rod lie no farther apart than the angles, as vectors.
float change_between(const Displacement& a, const Displacement& b) {
    const auto distance = [](const std::array<float, 3>& p, const std::array<float, 3>& q) {
        const float x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
        return std::sqrt(x * x + y * y + z * z);
    };
    const float change = distance(a.centre, b.centre) + distance(a.end, b.end);
    return change > 0.0F ? change + 1e-6F * (a.farthest + b.farthest) : 0.0F;
}

double interaction_range(const StepGeometry& step, std::size_t row) {
    return std::max(step.displacement[row] + step.ranges.displacement_limit, 0.5 * step.ranges.range);
}

}  // namespace

bool CollisionSearch::is_covered(const StepGeometry& step) {
    interaction_range_.resize(step.rods.size());
    parallel_for(step.rods.size(), [&](std::size_t i) { interaction_range_[i] = interaction_range(step, i); });
    largest_range_ = parallel_max(step.rods.size(), 0.0, [&](std::size_t i) { return interaction_range_[i]; });
    return neighbours_.covers(step.rods, step.box, interaction_range_);
}

double CollisionSearch::find(const StepGeometry& step, Contacts& contacts) {
    const Rods& rods = step.rods;
    interaction_range_.resize(rods.size());
    bounds_.resize(rods.size());
    parallel_for(rods.size(), [&](std::size_t i) {
        interaction_range_[i] = interaction_range(step, i);
        bounds_[i] = {rods.centre[i],
                      in_float(rods.axis[i]),
                      in_float(step.known.centre[i] - rods.centre[i]),
                      in_float(step.known.axis[i]),
                      static_cast<float>(0.5 * rods.length[i]),
                      static_cast<float>(0.5 * rods.diameter[i])};
    });
    neighbours_.set_skin(step.ranges.skin);
    neighbours_.update(rods, step.box, interaction_range_);
    search_blocks(step);
    contacts.clear();
    contacts.append(shares_.size(), [&](std::size_t share) -> const Contacts& { return shares_[share].contacts; });
    first_count_ = contacts.size();
    activated_.clear();
    displacement_.resize(rods.size());
    change_.resize(rods.size());
    known_beyond_.resize(rods.size());
    for (const std::uint32_t row : displaced_rows_) {
        if (row >= rods.size()) continue;
        displacement_[row] = {};
        change_[row] = known_beyond_[row] = 0.0F;
    }
    displaced_rows_.clear();
    late_.clear();
    double overlap = 0.0;
    for (const Found& share : shares_) overlap = std::max(overlap, share.overlap);
    return overlap;
}

void CollisionSearch::search_blocks(const StepGeometry& step) {
    shares_.resize(static_cast<std::size_t>(parallel::team_size(false)));
    for (Found& share : shares_) {
        share.contacts.clear();
        share.inactive.resize(0);
        share.overlap = 0.0;
    }
    in_block_.resize(neighbours_.block_count());
    parallel::for_shares(in_block_.size(), in_block_.size() <= 1, [&](std::size_t begin, std::size_t end) {
        const auto number = static_cast<std::size_t>(parallel::thread_number());
        Found& share = shares_[number];
        for (std::size_t block = begin; block < end; ++block) {
            const std::size_t known = share.inactive.size();
            search_block(block, step, share);
            in_block_[block] = {number, known, share.inactive.size()};
        }
    });
}

void CollisionSearch::search_block(std::size_t block, const StepGeometry& step, Found& found) {
    std::size_t count = 0;
    PairBatch batch;
    const auto range = static_cast<float>(step.ranges.range),
               margin = static_cast<float>(step.ranges.activation_margin);
    const auto sort_out = [&] {
        find_bounds(count, range, margin, batch);
        const auto inactive = batch.inactive.find(count);
        InactivePairs& pairs = found.inactive;
        std::size_t n = pairs.size();
        pairs.resize(n + inactive.size());
        for (const std::uint16_t k : inactive) {
            pairs.i[n] = batch.i[k];
            pairs.j[n] = batch.j[k];
            pairs.slack[n] = pairs.left[n] = batch.slack[k];
            pairs.slab[n] = {{batch.normal[0][k], batch.normal[1][k], batch.normal[2][k]}, batch.in_block[k]};
            ++n;
        }
        for (std::size_t k = 0; k < count; ++k)
            if (batch.inactive.marks()[k] == 0)
                narrow_phase(batch.i[k], key_of(block, batch.i[k], batch.in_block[k], step.rods), batch.in_block[k],
                             step, found);
        count = 0;
    };
    neighbours_.for_close_pairs(block, [&](std::uint32_t row, std::size_t pair) {
        const auto& [i, j, image] = neighbours_.key(row, pair);
        const RodBounds &a = bounds_[i], &b = bounds_[j];
        const auto between = in_float(b.centre + step.box.displacement(image) - a.centre);
        batch.i[count] = row;
        batch.j[count] = j;
        batch.in_block[count] = static_cast<std::uint16_t>(pair - block * NeighbourList::block_size);
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
        if (++count == PairBatch::size) sort_out();
    });
    sort_out();
}

void CollisionSearch::narrow_phase(std::uint32_t row, const PairKey& key, std::uint16_t in_block,
                                   const StepGeometry& step, Found& found) const {
    const auto& [i, j, image] = key;
    const Vec3 displacement = step.box.displacement(image);
    const PairGeometry before = pair_geometry(step.rods, i, j, displacement, step.rods.centre, step.rods.axis);
    const NearestPoints nearest = nearest_points(before);
    const double gap = norm(nearest.separation) - before.radii;
    found.overlap = std::max(found.overlap, -gap);

    const PairGeometry after = pair_geometry(step.rods, i, j, displacement, step.known.centre, step.known.axis);
    const NearestPoints nearest_after = nearest_points(after);
    const double distance_after = norm(nearest_after.separation), gap_after = distance_after - after.radii;
    const bool passed_through = dot(nearest.separation, nearest_after.separation) <= 0.0;
    if (gap < step.ranges.range || passed_through || gap_after < step.ranges.activation_margin) {
        append(key, before, nearest, after, step, found.contacts);
        return;
    }
    const double slack = gap_after - 1e-6 * after.radii;
    // From the rod that the neighbour list names first to the other.
    const auto normal = in_float((row == i ? 1.0 : -1.0) / distance_after * nearest_after.separation);
    found.inactive.push_back(
        row, row == i ? j : i, static_cast<float>(slack),
        {{in_normal_units(normal[0]), in_normal_units(normal[1]), in_normal_units(normal[2])}, in_block});
}

/// Appends the contacts of a pair.
void CollisionSearch::append(const PairKey& key, const PairGeometry& before, const NearestPoints& nearest,
                             const PairGeometry& after, const StepGeometry& step, Contacts& contacts) const {
    const std::size_t first = contacts.size();
    const auto own_image = key.i == key.j && !step.forces_at_start ? contact_with_own_image(key, after) : std::nullopt;
    if (own_image) {
        contacts.push_back(*own_image, key.image, ContactFeature::nearest);
        contacts.contact[first].gap = norm(nearest.separation) - before.radii;
        return;
    }
    append_moving_contacts(key, {before, nearest, after, step.normals_after},
                           interaction_range_[key.i] + interaction_range_[key.j], step.box.dimensions(), contacts);
}

/// Inactive pairs are no contacts until they are activated; once the list is another one, any pair may be one.
bool CollisionSearch::is_contact(const PairKey& key, const Contacts& contacts) const {
    const PairKey listed = in_order_of_rows(key);
    if (std::binary_search(activated_.begin(), activated_.end(), listed)) return true;
    if (!neighbours_.built_while_widened()) return false;
    const auto pair_at = [&](std::size_t l) { return in_order_of_rows(pair_of(contacts, l)); };
    std::size_t low = 0, high = first_count_;
    while (low < high) {
        const std::size_t middle = low + (high - low) / 2;
        if (pair_at(middle) < listed)
            low = middle + 1;
        else
            high = middle;
    }
    return low < first_count_ && pair_at(low) == listed;
}

/// By how much the slab of an inactive pair stays empty where forces take the rods, at least.
float CollisionSearch::width_of_slab(const InactivePairs& pairs, std::size_t k) const {
    const Displacement &i = displacement_[pairs.i[k]], &j = displacement_[pairs.j[k]];
    const float farthest = i.farthest + j.farthest;
    const auto along = [&normal = pairs.slab[k].normal](const std::array<float, 3>& a) {
        return normal_unit * (static_cast<float>(normal[0]) * a[0] + static_cast<float>(normal[1]) * a[1] +
                              static_cast<float>(normal[2]) * a[2]);
    };
    const float width =
        pairs.slack[k] + along(j.centre) - along(i.centre) - std::fabs(along(i.end)) - std::fabs(along(j.end));
    return width - (i.inaccuracy + j.inaccuracy + 2.0F * normal_unit * farthest);
}

/// Calls gap_at_end(i, pair) for the inactive pairs of a block that forces may have brought together since the last
/// search, and keeps what it returns.
template <class GapAtEnd>
void CollisionSearch::search_inactive(std::size_t block, GapAtEnd&& gap_at_end) {
    const auto [share, begin, end] = in_block_[block];
    InactivePairs& pairs = shares_[share].inactive;
    // Most have more left than any displacement since: those are passed over by this alone.
    MarkedNumbers<NeighbourList::block_size> used_up;
    take_off_changes(end - begin, pairs.i.data() + begin, pairs.j.data() + begin, change_.data(),
                     pairs.left.data() + begin, used_up.marks());
    for (const std::uint16_t number : used_up.find(end - begin)) {
        const std::size_t k = begin + number;
        pairs.left[k] = width_of_slab(pairs, k);
        if (pairs.left[k] <= 0.0F) pairs.left[k] = gap_at_end(pairs.i[k], pairs.slab[k].in_block);
    }
}

/// The same for late pairs, which have no slab.
template <class GapAtEnd>
void CollisionSearch::search_late(std::size_t begin, std::size_t end, GapAtEnd&& gap_at_end) {
    MarkedNumbers<NeighbourList::block_size> used_up;
    take_off_changes(end - begin, late_.i.data() + begin, late_.j.data() + begin, change_.data(),
                     late_.left.data() + begin, used_up.marks());
    for (const std::uint16_t number : used_up.find(end - begin)) {
        const std::size_t k = begin + number;
        late_.left[k] = gap_at_end(late_.i[k], late_.number[k]);
    }
}

/// By rows, where pairs look for them: 0 for rods without contacts.
void CollisionSearch::take_displacements(const EndConfiguration& end) {
    displaced_rows_.assign(end.rows().begin(), end.rows().end());
    parallel_for(end.rows().size(), [&](std::size_t k) {
        Displacement& displacement = displacement_[end.rows()[k]];
        change_[end.rows()[k]] = change_between(displacement, end.displacements()[k]);
        displacement = end.displacements()[k];
    });
}

/// Lets those rods come farther that forces displace beyond what was thought, and somewhat farther than they do: with
/// the next forces they will go a little elsewhere.
std::vector<NeighbourList::Widening> CollisionSearch::widen(const StepGeometry& step, const EndConfiguration& end) {
    const double limit = step.ranges.displacement_limit;
    std::vector<NeighbourList::Widening> farther;
    for (std::size_t k = 0; k < end.rows().size(); ++k) {
        const std::uint32_t row = end.rows()[k];
        const double known = known_beyond_[row], beyond = end.displacements()[k].farthest - limit;
        if (beyond <= known) continue;
        const double spare = std::max(neighbours_.spare_range(row) - (beyond - known), 0.0);
        known_beyond_[row] = static_cast<float>(beyond + std::min(foresight * limit, spare));
        farther.push_back({row, known_beyond_[row] - known});
    }
    if (farther.empty() || neighbours_.widen(farther)) return farther;
    std::vector<double> ranges = interaction_range_;
    for (std::size_t row = 0; row < ranges.size(); ++row) ranges[row] += known_beyond_[row];
    neighbours_.widen_to(step.rods, step.box, ranges);
    return farther;
}

std::vector<PairKey> CollisionSearch::violated_pairs(const StepGeometry& step, const Contacts& contacts,
                                                     const EndConfiguration& end) {
    take_displacements(end);
    std::vector<std::vector<PairKey>> found;
    const auto make_places = [&](std::size_t parts) { found.resize(std::max(found.size(), parts)); };
    const auto gap_at_end = [&](std::size_t part, const PairKey& key) {
        constexpr float settled = std::numeric_limits<float>::infinity();  // a contact from now on
        const PairGeometry pair = end.pair(step.box, key);
        const double gap = pair_gap(pair);
        if (gap >= 0.0) return static_cast<float>(gap - 1e-6 * pair.radii);
        if (!is_contact(key, contacts)) found[part].push_back(key);
        return settled;
    };
    if (!neighbours_.built_while_widened()) {
        make_places(in_block_.size());
        parallel_for_parts(in_block_.size(), [&](std::size_t block) {
            search_inactive(block, [&](std::uint32_t i, std::size_t in_block) {
                return gap_at_end(block, key_of(block, i, in_block, step.rods));
            });
        });
        make_places(late_.left.size() / NeighbourList::block_size + 1);
        parallel_for_blocks(late_.left.size(), NeighbourList::block_size,
                            [&](std::size_t block, std::size_t first, std::size_t last) {
                                search_late(first, last, [&](std::uint32_t i, std::size_t number) {
                                    return gap_at_end(block, in_order_of_ids(neighbours_.key(i, number), step.rods.id));
                                });
                            });
    }
    // Pairs that were passed over because no force was thought to take rods so far; and all, once the list is another.
    const auto farther = widen(step, end);
    const bool are_all_new = neighbours_.built_while_widened();
    const bool in_blocks = are_all_new || step.rods.size() < rods_per_one_beyond * farther.size();
    const std::size_t parts = in_blocks ? neighbours_.block_count() : farther.size();
    std::vector<std::vector<LatePair>> late(parts);
    make_places(parts);
    parallel_for_parts(parts, [&](std::size_t part) {
        const auto look = [&](std::uint32_t i, std::size_t number) {
            const PairKey key = neighbours_.key(i, number);
            const float left = gap_at_end(part, in_order_of_ids(key, step.rods.id));
            if (!are_all_new) late[part].push_back({i, key.j, number, left});
        };
        if (in_blocks)
            neighbours_.for_close_pairs(part, look);
        else
            neighbours_.for_close_pairs_of(farther[part].row, look);
    });
    for (const auto& part : late)
        for (const LatePair& pair : part) late_.push_back(pair);
    std::vector<PairKey> all;
    for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

Contacts CollisionSearch::activate(std::span<const PairKey> violated, const StepGeometry& step) {
    Contacts contacts;
    for (const PairKey& key : violated) {
        const auto& [i, j, image] = key;
        const Vec3 displacement = step.box.displacement(image);
        const PairGeometry before = pair_geometry(step.rods, i, j, displacement, step.rods.centre, step.rods.axis);
        const PairGeometry after = pair_geometry(step.rods, i, j, displacement, step.known.centre, step.known.axis);
        append(key, before, nearest_points(before), after, step, contacts);
        activated_.push_back(in_order_of_rows(key));
    }
    std::sort(activated_.begin(), activated_.end());
    return contacts;
}

}  // namespace jostle
