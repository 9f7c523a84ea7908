#pragma once

#include "jostle/contact/end_configuration.hpp"

namespace jostle {

/// The pairs in contact that overlap by more than `max_overlap` at the end of the step: for each its nearest points
/// there, with the normal and the gap there, as ContactFeature::relinearised. In order. The gap there is the gap
/// after the known motion of these contacts.
///
/// The contact problem is linear in the motion of its step: rods that are turned far in one step overlap to second
/// order in the angle, where they did not touch before.
Contacts relinearised_contacts(const Contacts& contacts, const Box& box, const EndConfiguration& end,
                               double max_overlap);

}  // namespace jostle
