#pragma once

#include "jostle/contact/collision_search.hpp"

namespace jostle {

/// The pairs in contact that overlap by more than `most` where rods lie as `after` says: for each its nearest points
/// there, with the normal and the gap there, as ContactFeature::pushed. In order.
///
/// The contact problem is linear in the motion of its step: rods that are turned far in one step overlap to second
/// order in the angle, where they did not touch before.
Contacts pushed_overlaps(const Contacts& contacts, const Rods& rods, const Box& box, const RodAfter& after,
                         double most);

}  // namespace jostle
