#include "jostle/contact/find_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "jostle/contact/segment_distance.hpp"
#include "jostle/math/rotation.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

constexpr std::size_t pairs_per_block = 512;
constexpr double largest_sine_with_ends = 0.15;
/// The nearest point is left out between two ends if these are no farther apart than this (in D) beyond its distance.
constexpr double negligible_sag = 5e-4;
/// Ends nearer than this (in D) to a point that is already a contact add nothing but a nearly dependent row.
constexpr double least_spacing = 0.1;

/// The two rods of a pair as the narrow phase sees them.
struct PairGeometry {
    Vec3 between;  ///< from centre i to centre j, image included
    Vec3 axis_i, axis_j;
    double half_i, half_j;
    double radii;  ///< (D_i + D_j)/2
};

PairGeometry geometry(const Rods& rods, std::size_t i, std::size_t j, const Vec3& displacement,
                      std::span<const Vec3> centre, std::span<const Vec3> axis) {
    return {centre[j] + displacement - centre[i],       axis[i], axis[j], 0.5 * rods.length[i], 0.5 * rods.length[j],
            0.5 * (rods.diameter[i] + rods.diameter[j])};
}

double nearest_gap(const PairGeometry& pair) {
    const auto points = nearest_points(pair.between, pair.axis_i, pair.half_i, pair.axis_j, pair.half_j);
    return norm(points.separation) - pair.radii;
}

/// One possible contact point of a pair.
struct Point {
    double s_i, s_j, distance;
    Vec3 separation;
    ContactFeature feature;
};

/// The direction along which to push apart, also where the axes cross or coincide and the separation says nothing.
Vec3 contact_normal(const Vec3& separation, double distance, const PairGeometry& pair) {
    if (distance > 1e-9 * pair.radii) return separation / distance;
    const Vec3 across = cross(pair.axis_i, pair.axis_j);
    const double sine = norm(across);
    return sine > 1e-9 ? across / sine : any_perpendicular(pair.axis_i);
}

/// Adds the ends of the stretch along which the rods lie side by side: at most one to each side of the nearest points.
struct EndPoints {
    Point lower, upper;  ///< below and above the nearest point along axis i
    bool has_lower = false, has_upper = false;

    void offer(const Point& point, double s_nearest, double spacing) {
        const double ahead = point.s_i - s_nearest;
        if (std::fabs(ahead) < spacing) return;
        bool& present = ahead < 0.0 ? has_lower : has_upper;
        Point& kept = ahead < 0.0 ? lower : upper;
        if (!present || point.distance < kept.distance) kept = point;
        present = true;
    }
};

EndPoints end_points(const PairGeometry& pair, const Point& nearest, double range) {
    EndPoints ends;
    const double spacing = least_spacing * pair.radii;
    for (const double end : {-pair.half_j, pair.half_j}) {
        const auto foot = nearest_point(pair.between + end * pair.axis_j, pair.axis_i, pair.half_i);
        const double distance = norm(foot.separation);
        if (std::fabs(foot.s) < pair.half_i && distance < range)
            ends.offer({foot.s, end, distance, foot.separation, ContactFeature::end_of_j}, nearest.s_i, spacing);
    }
    for (const double end : {-pair.half_i, pair.half_i}) {
        const auto foot = nearest_point(end * pair.axis_i - pair.between, pair.axis_j, pair.half_j);
        const double distance = norm(foot.separation);
        if (std::fabs(foot.s) < pair.half_j && distance < range)
            ends.offer({end, foot.s, distance, -foot.separation, ContactFeature::end_of_i}, nearest.s_i, spacing);
    }
    return ends;
}

void append_contacts(const NeighbourPair& who, const PairGeometry& pair, const Image& image, double reach,
                     Contacts& found, double& overlap) {
    const auto points = nearest_points(pair.between, pair.axis_i, pair.half_i, pair.axis_j, pair.half_j);
    const double range = pair.radii + reach;
    const double squared = squared_norm(points.separation);
    if (squared >= range * range) return;
    const Point nearest{points.s_i, points.s_j, std::sqrt(squared), points.separation, ContactFeature::nearest};
    overlap = std::max(overlap, pair.radii - nearest.distance);

    const auto add = [&](const Point& point) {
        const Vec3 normal = contact_normal(point.separation, point.distance, pair);
        found.push_back({who.i, who.j, normal, point.s_i, point.s_j, point.distance - pair.radii}, image,
                        point.feature);
    };
    const double squared_sine = squared_norm(cross(pair.axis_i, pair.axis_j));
    if (pair.half_i == 0.0 || pair.half_j == 0.0 || squared_sine > largest_sine_with_ends * largest_sine_with_ends) {
        add(nearest);
        return;
    }
    const EndPoints ends = end_points(pair, nearest, range);
    const bool drop_middle =
        ends.has_lower && ends.has_upper &&
        std::max(ends.lower.distance, ends.upper.distance) - nearest.distance < negligible_sag * pair.radii;
    if (!drop_middle) add(nearest);
    if (ends.has_lower) add(ends.lower);
    if (ends.has_upper) add(ends.upper);
}

}  // namespace

double find_contacts(const Rods& rods, const Box& box, const NeighbourList& neighbours, std::span<const double> reach,
                     Contacts& contacts) {
    const auto pairs = neighbours.pairs();
    const std::size_t block_count = (pairs.size() + pairs_per_block - 1) / pairs_per_block;
    std::vector<Contacts> blocks(block_count);
    std::vector<double> overlaps(block_count, 0.0);
    parallel_for_blocks(pairs.size(), pairs_per_block, [&](std::size_t block, std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            if (neighbours.surely_beyond_reach(pairs[k])) continue;
            const std::uint32_t i = pairs[k].i, j = pairs[k].j;
            const Image image = neighbours.image_now(pairs[k], rods);
            const PairGeometry pair = geometry(rods, i, j, box.displacement(image), rods.centre, rods.axis);
            const double outer = pair.half_i + pair.half_j + pair.radii + reach[i] + reach[j];
            if (squared_norm(pair.between) >= outer * outer) continue;
            append_contacts(pairs[k], pair, image, reach[i] + reach[j], blocks[block], overlaps[block]);
        }
    });
    contacts.clear();
    for (const Contacts& block : blocks) {
        contacts.contact.insert(contacts.contact.end(), block.contact.begin(), block.contact.end());
        contacts.image.insert(contacts.image.end(), block.image.begin(), block.image.end());
        contacts.feature.insert(contacts.feature.end(), block.feature.begin(), block.feature.end());
    }
    double overlap = 0.0;
    for (const double value : overlaps) overlap = std::max(overlap, value);
    return overlap;
}

bool any_unseen_collision(const Rods& rods, const Box& box, const NeighbourList& neighbours, const Movement& movement) {
    const auto pairs = neighbours.pairs();
    const auto unseen = [&](std::size_t k) {
        const std::uint32_t i = pairs[k].i, j = pairs[k].j;
        if (neighbours.surely_beyond_reach(pairs[k])) return false;
        const double seen = movement.reach[i] + movement.reach[j];
        const double needed = movement.needed[i] + movement.needed[j];
        if (needed <= seen) return false;
        const Vec3 displacement = box.displacement(neighbours.image_now(pairs[k], rods));
        PairGeometry pair = geometry(rods, i, j, displacement, rods.centre, rods.axis);
        const double before = nearest_gap(pair);
        if (before < seen || before >= needed) return false;
        const Velocities& velocities = movement.velocities;
        pair.between += movement.time_step * (velocities.linear[j] - velocities.linear[i]);
        pair.axis_i = rotated(pair.axis_i, movement.time_step * velocities.angular[i]);
        pair.axis_j = rotated(pair.axis_j, movement.time_step * velocities.angular[j]);
        const double after = nearest_gap(pair);
        return after < movement.shift[i] + movement.shift[j];
    };
    return parallel_max(pairs.size(), 0.0, [&](std::size_t k) { return unseen(k) ? 1.0 : 0.0; }) > 0.0;
}

double gap_at(const Contacts& contacts, std::size_t l, const Rods& rods, const Box& box, std::span<const Vec3> centre,
              std::span<const Vec3> axis) {
    const Contact& contact = contacts.contact[l];
    const auto [between, axis_i, axis_j, half_i, half_j, radii] =
        geometry(rods, contact.i, contact.j, box.displacement(contacts.image[l]), centre, axis);
    Vec3 separation;
    switch (contacts.feature[l]) {
        case ContactFeature::nearest:
            separation = nearest_points(between, axis_i, half_i, axis_j, half_j).separation;
            break;
        case ContactFeature::end_of_i:
            separation = -nearest_point(contact.arm_i * axis_i - between, axis_j, half_j).separation;
            break;
        case ContactFeature::end_of_j:
            separation = nearest_point(between + contact.arm_j * axis_j, axis_i, half_i).separation;
            break;
    }
    const double distance = dot(separation, contact.normal) < 0.0 ? -norm(separation) : norm(separation);
    return distance - radii;
}

}  // namespace jostle
