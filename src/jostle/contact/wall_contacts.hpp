#pragma once

#include <span>

#include "jostle/contact/contacts.hpp"
#include "jostle/contact/end_configuration.hpp"
#include "jostle/rods/wall.hpp"

namespace jostle {

/// The contact of the point at `arm` of a rod with a wall, as the rod lies now.
Contact contact_with_wall(const Wall& wall, const Rods& rods, std::uint32_t row, double arm);

/// Appends the contacts of rods with the walls of their box whose gap is below the rod's range. `ranges`: (N). Returns
/// the largest overlap with a wall, max(0, -gap).
double append_wall_contacts(const Rods& rods, const Box& box, std::span<const double> ranges, Contacts& contacts);

/// Those of `contacts` with walls that overlap by more than `max_overlap` where contact forces take their rods, with
/// the normals and the gaps that they have there (gap_after); `gap` is that before the step.
Contacts relinearised_wall_contacts(const Contacts& contacts, const Box& box, const EndConfiguration& end,
                                    double max_overlap);

}  // namespace jostle
