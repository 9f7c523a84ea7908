#pragma once

#include <span>

#include "jostle/contact/contacts.hpp"
#include "jostle/contact/neighbour_list.hpp"

namespace jostle {

/// Finds all contacts with a gap below range_i + range_j among the pairs of `neighbours`, which must cover that range.
///
/// Finds those with walls and fixed rods of the box, too, with a gap below range_j. Two rods meet at their nearest
/// points, nearly parallel ones at the ends of their overlap too (pair_contacts.hpp). `ranges`: (N), how far any point
/// of each rod may come towards others. Returns the largest overlap, max(0, -gap).
double find_contacts(const Rods& rods, const Box& box, const NeighbourList& neighbours, std::span<const double> ranges,
                     Contacts& contacts);

}  // namespace jostle
