#pragma once

#include <optional>
#include <span>

#include "jostle/contact/contacts.hpp"
#include "jostle/contact/segment_distance.hpp"
#include "jostle/rods/box.hpp"

namespace jostle {

/// Two rods as the search for contacts sees them.
struct PairGeometry {
    Vec3 centre_separation;  ///< from centre i to centre j, image included
    Vec3 axis_i, axis_j;
    double half_i, half_j;  ///< half lengths
    double radii;           ///< (D_i + D_j)/2
};

/// Rods i and j with these axes, whose centres are `between` apart.
inline PairGeometry pair_geometry(const Rods& rods, std::size_t i, std::size_t j, const Vec3& centre_separation,
                                  const Vec3& axis_i, const Vec3& axis_j) {
    return {centre_separation,
            axis_i,
            axis_j,
            0.5 * rods.length[i],
            0.5 * rods.length[j],
            0.5 * (rods.diameter[i] + rods.diameter[j])};
}

/// Rods i and j, the latter displaced, when they lie at `centre` and `axis`.
inline PairGeometry pair_geometry(const Rods& rods, std::size_t i, std::size_t j, const Vec3& displacement,
                                  std::span<const Vec3> centre, std::span<const Vec3> axis) {
    return pair_geometry(rods, i, j, centre[j] + displacement - centre[i], axis[i], axis[j]);
}

/// The nearest points of a pair's segments.
inline NearestPoints nearest_points(const PairGeometry& pair) {
    return nearest_points(pair.centre_separation, pair.axis_i, pair.half_i, pair.axis_j, pair.half_j);
}

/// Distance of the two surfaces.
inline double pair_gap(const PairGeometry& pair) {
    return norm(nearest_points(pair).separation) - pair.radii;
}

/// Whether a pair is nearer than touching. Most that are not are told apart by the distance of the lines through their
/// axes.
inline bool pair_overlaps(const PairGeometry& pair) {
    const Vec3 across = cross(pair.axis_i, pair.axis_j);
    const double shift = dot(pair.centre_separation, across);
    if (shift * shift > 1.001 * pair.radii * pair.radii * squared_norm(across)) return false;
    return pair_gap(pair) < 0.0;
}

/// Appends the contacts of a pair: its nearest points, and for nearly parallel rods the ends of the stretch along which
/// they lie side by side, where they are nearer than `range` beyond touching
/// (docs/decisions/0003-two-point-contacts.md):
///
///          o------------------o            sin(angle) < 0.3: ends within range are added
///     ============================ i       if both ends are as far away as the nearest points, to 5e-4 D,
///     =====================o======         they replace them (three contacts of two straight rods would
///          o  nearest      o               make A singular); of a rod and its image the nearest points alone
///
/// `nearest`: of `pair`; `distance`: between those points. In two dimensions normals stay in the plane: where the axes
/// of two rods cross, the one whose end is nearer to the crossing is to be drawn back across the axis of the other.
void append_contacts(const PairKey& key, const PairGeometry& pair, const NearestPoints& nearest, double distance,
                     double range, int dimensions, Contacts& contacts);

/// The gap at a contact when its rods lie as in `pair`: its points follow their feature, and rods that have passed
/// through each other count as overlapping.
double gap_of_contact(const Contact& contact, ContactFeature feature, const PairGeometry& pair);

/// A pair before and after the known motion of a step.
struct MovingPair {
    const PairGeometry& before;
    const NearestPoints& nearest;  ///< of `before`
    const PairGeometry& after;
    double normals_after;  ///< contacts have the normals and arms of the pair after this part of its way, 0 to 1
};

/// Appends the contacts of a pair that moves, with their gaps before and after the motion. If the rods have passed
/// through each other on the way, normals and arms are those before. `range`, `dimensions`: as above.
void append_moving_contacts(const PairKey& key, const MovingPair& pair, double range, int dimensions,
                            Contacts& contacts);

/// The contact of a pair that is in contact already, at the points that are nearest at the end of the step
/// (relinearised_contacts.hpp). None if the axes cross there, where no normal can be told. `before`, `at_end`: the pair
/// before the step and at its end.
std::optional<Contact> relinearised_contact(const Contact& known, const PairGeometry& before,
                                            const PairGeometry& at_end);

}  // namespace jostle
