#include "jostle/contact/pair_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "jostle/rods/configuration.hpp"

namespace jostle {

namespace {

constexpr double largest_sine_with_ends = 0.3;
/// The nearest point is left out between two ends if these are no farther apart than this (in D) beyond its distance.
constexpr double negligible_sag = 5e-4;
/// Ends nearer than this (in D) to a point that is already a contact add nothing but a nearly dependent row.
constexpr double least_spacing = 0.1;

/// Axes nearer to each other than this (in D) cross, or coincide.
constexpr double crossing = 1e-9;

/// One possible contact point of a pair.
struct Point {
    double s_i, s_j, distance;
    Vec3 separation;
    ContactFeature feature;
};

/// The direction along which to push apart, also where the axes cross or coincide and the separation says nothing.
Vec3 contact_normal(const Vec3& separation, double distance, const PairGeometry& pair) {
    if (distance > crossing * pair.radii) return separation / distance;
    const Vec3 across = cross(pair.axis_i, pair.axis_j);
    const double sine = norm(across);
    return sine > 1e-9 ? across / sine : any_perpendicular(pair.axis_i);
}

/// The contact of two rods in a plane whose axes cross, where no direction between them says how to push them apart.
///
///           | i          the end of j is to be drawn back across the axis of i: the least way out. The gap counts from
///     ======+==| j       where that end only touches the axis.
///  normal <-|
Contact contact_across(const PairKey& key, const PairGeometry& pair, const NearestPoints& points) {
    Contact contact{key.i, key.j, any_perpendicular(pair.axis_i), points.s_i, points.s_j, -pair.radii, -pair.radii};
    const double sine = norm(cross(pair.axis_i, pair.axis_j));
    if (!(sine > 1e-9)) return contact;  // the axes coincide
    const double beyond_i = pair.half_i - std::fabs(points.s_i), beyond_j = pair.half_j - std::fabs(points.s_j);
    const bool of_j = beyond_j <= beyond_i;  // which end is drawn back
    const Vec3 &drawn = of_j ? pair.axis_j : pair.axis_i, &other = of_j ? pair.axis_i : pair.axis_j;
    double &arm = of_j ? contact.arm_j : contact.arm_i, &foot = of_j ? contact.arm_i : contact.arm_j;
    const double end = std::copysign(of_j ? pair.half_j : pair.half_i, arm);
    const double cosine = dot(drawn, other), half_of_other = of_j ? pair.half_i : pair.half_j;
    const Vec3 outwards = (std::copysign(1.0, arm) / sine) * (drawn - cosine * other);
    foot = std::clamp(foot + (end - arm) * cosine, -half_of_other, half_of_other);
    arm = end;
    contact.normal = of_j ? -outwards : outwards;
    contact.gap = contact.gap_after = -pair.radii - (of_j ? beyond_j : beyond_i) * sine;
    return contact;
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
        const auto foot = nearest_point(pair.centre_separation + end * pair.axis_j, pair.axis_i, pair.half_i);
        const double distance = norm(foot.separation);
        if (std::fabs(foot.s) < pair.half_i && distance < range)
            ends.offer({foot.s, end, distance, foot.separation, ContactFeature::end_of_j}, nearest.s_i, spacing);
    }
    for (const double end : {-pair.half_i, pair.half_i}) {
        const auto foot = nearest_point(end * pair.axis_i - pair.centre_separation, pair.axis_j, pair.half_j);
        const double distance = norm(foot.separation);
        if (std::fabs(foot.s) < pair.half_j && distance < range)
            ends.offer({end, foot.s, distance, -foot.separation, ContactFeature::end_of_i}, nearest.s_i, spacing);
    }
    return ends;
}

/// The pair after a part of its way.
PairGeometry on_the_way(const MovingPair& pair) {
    const PairGeometry &before = pair.before, &after = pair.after;
    const double part = pair.normals_after;
    PairGeometry here = before;
    here.centre_separation += part * (after.centre_separation - before.centre_separation);
    here.axis_i = axis_between(before.axis_i, after.axis_i, part);
    here.axis_j = axis_between(before.axis_j, after.axis_j, part);
    return here;
}

/// Appends the contacts of a pair as it lies on its way. Returns whether there are any: not if the rods have passed
/// through each other by then.
bool append_on_the_way(const PairKey& key, const MovingPair& pair, double range, int dimensions, Contacts& contacts) {
    if (pair.normals_after == 0.0) return false;
    const PairGeometry here = on_the_way(pair);
    const NearestPoints nearest = nearest_points(here);
    if (dot(nearest.separation, pair.nearest.separation) <= 0.0) return false;
    append_contacts(key, here, nearest, norm(nearest.separation), range, dimensions, contacts);
    return true;
}

}  // namespace

void append_contacts(const PairKey& key, const PairGeometry& pair, const NearestPoints& points, double distance,
                     double range, int dimensions, Contacts& contacts) {
    if (dimensions == 2 && distance <= crossing * pair.radii) {
        contacts.push_back(contact_across(key, pair, points), key.image, ContactFeature::nearest);
        return;
    }
    const Point nearest{points.s_i, points.s_j, distance, points.separation, ContactFeature::nearest};
    const auto add = [&](const Point& point) {
        const Vec3 normal = contact_normal(point.separation, point.distance, pair);
        const double gap = point.distance - pair.radii;
        contacts.push_back({key.i, key.j, normal, point.s_i, point.s_j, gap, gap}, key.image, point.feature);
    };
    const double squared_sine = squared_norm(cross(pair.axis_i, pair.axis_j));
    const bool own_image = key.i == key.j;  // no contact point resists more than one: all open as the rod turns
    if (own_image || pair.half_i == 0.0 || pair.half_j == 0.0 ||
        squared_sine > largest_sine_with_ends * largest_sine_with_ends) {
        add(nearest);
        return;
    }
    const EndPoints ends = end_points(pair, nearest, pair.radii + range);
    const bool drop_middle =
        ends.has_lower && ends.has_upper &&
        std::max(ends.lower.distance, ends.upper.distance) - nearest.distance < negligible_sag * pair.radii;
    if (!drop_middle) add(nearest);
    if (ends.has_lower) add(ends.lower);
    if (ends.has_upper) add(ends.upper);
}

double gap_of_contact(const Contact& contact, ContactFeature feature, const PairGeometry& pair) {
    Vec3 separation;
    switch (feature) {
        case ContactFeature::nearest:
        case ContactFeature::relinearised:
            separation = nearest_points(pair).separation;
            break;
        case ContactFeature::end_of_i:
            separation = -nearest_point(contact.arm_i * pair.axis_i - pair.centre_separation, pair.axis_j, pair.half_j)
                              .separation;
            break;
        case ContactFeature::end_of_j:
            separation = nearest_point(pair.centre_separation + contact.arm_j * pair.axis_j, pair.axis_i, pair.half_i)
                             .separation;
            break;
    }
    const double distance = dot(separation, contact.normal) < 0.0 ? -norm(separation) : norm(separation);
    return distance - pair.radii;
}

void append_moving_contacts(const PairKey& key, const MovingPair& pair, double range, int dimensions,
                            Contacts& contacts) {
    const std::size_t first = contacts.size();
    const bool moved = append_on_the_way(key, pair, range, dimensions, contacts);
    if (!moved)
        append_contacts(key, pair.before, pair.nearest, norm(pair.nearest.separation), range, dimensions, contacts);
    for (std::size_t l = first; l < contacts.size(); ++l) {
        Contact& contact = contacts.contact[l];
        const ContactFeature feature = contacts.feature[l];
        if (moved)
            contact.gap = feature == ContactFeature::nearest ? norm(pair.nearest.separation) - pair.before.radii
                                                             : gap_of_contact(contact, feature, pair.before);
        contact.gap_after = gap_of_contact(contact, feature, pair.after);
    }
}

std::optional<Contact> relinearised_contact(const Contact& known, const PairGeometry& before,
                                            const PairGeometry& at_end) {
    const NearestPoints nearest = nearest_points(at_end);
    const double distance = norm(nearest.separation);
    if (!(distance > 0.0)) return std::nullopt;
    const double side = dot(nearest.separation, known.normal) < 0.0 ? -1.0 : 1.0;  // passed through?
    Contact contact;
    contact.i = known.i;
    contact.j = known.j;
    contact.normal = (side / distance) * nearest.separation;
    contact.arm_i = nearest.s_i;
    contact.arm_j = nearest.s_j;
    const Vec3 points = before.centre_separation + contact.arm_j * before.axis_j - contact.arm_i * before.axis_i;
    contact.gap = dot(points, contact.normal) - at_end.radii;
    contact.gap_after = side * distance - at_end.radii;
    return contact;
}

}  // namespace jostle
