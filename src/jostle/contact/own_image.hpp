#pragma once

#include <optional>

#include "jostle/contact/contacts.hpp"
#include "jostle/contact/pair_contacts.hpp"

namespace jostle {

/// How far a rod may be inclined from side by side with its image, which is `apart` from it, to either side (radians):
/// 0 where that is no more than `diameter`, pi/2 where it is `length` + `diameter` or more.
double inclination_between_images(double apart, double length, double diameter);
/// The inverse: how far from its image a rod has to be to be inclined so far (radians, >= 0), at least.
double distance_between_images(double inclination, double length, double diameter);

/// Where a rod that turns comes to touch its own image.
///
///      _____          Both stay parallel, so their gap depends on one angle alone, that by which the rod is inclined
///     /    /          from side by side; and it is of second order there. As a gap it would be no measure of how far
///    /    /           the rod may turn, and its gradient none of the force. So contacts have points and normal as at
///   /    /            touching, and their gap after the known motion is the way that is left until then.
///
/// `at_touching`: the pair, turned in the plane of its axis and the image.
struct OwnImageTouch {
    PairGeometry at_touching;
    double turn;  ///< angle until then (radians), negative beyond
};

/// `pair`: a rod and its image. Empty where no inclination lets them touch: the image is farther than L + D, or nearer
/// than D.
std::optional<OwnImageTouch> touch_of_own_image(const PairGeometry& pair);

/// The contact of rod `key.i` with its image when they lie as in `pair`, with the way left as its gap after the known
/// motion; none where they cannot touch. The gap is left at 0.
std::optional<Contact> contact_with_own_image(const PairKey& key, const PairGeometry& pair);

}  // namespace jostle
