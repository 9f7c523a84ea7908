#pragma once

#include <span>

#include "jostle/contact/contacts.hpp"
#include "jostle/contact/neighbour_list.hpp"
#include "jostle/rods/velocities.hpp"

namespace jostle {

/// Finds all contacts with a gap below reach_i + reach_j among the pairs of `neighbours`, which must cover that reach.
///
/// Two rods meet at their nearest points. Nearly parallel ones can turn into each other at both ends of the stretch
/// along which they lie side by side, so they get the ends of that stretch as contacts as well
/// (docs/decisions/0003-two-point-contacts.md):
///
///          o------------------o            sin(angle) < 0.15: ends within reach are added
///     ============================ i       if both ends are as far away as the nearest points, to 5e-4 D,
///     =====================o======         they replace them (three contacts of two straight rods would
///          o  nearest      o               make A singular)
///
/// `reach`: (N), how far any point of each rod may come towards others in this step. Returns the largest overlap,
/// max(0, -gap).
double find_contacts(const Rods& rods, const Box& box, const NeighbourList& neighbours, std::span<const double> reach,
                     Contacts& contacts);

/// How rods move in a step, and how far contacts were looked for.
struct Movement {
    std::span<const double> reach;   ///< (N) of the contacts found
    std::span<const double> needed;  ///< (N) the reach that the movement turned out to need
    std::span<const double> shift;   ///< (N) each rod's part in the largest gap that still counts as touching
    const Velocities& velocities;    ///< (N) of the movement
    double time_step;
};

/// Whether some pair beyond the reach of the contacts found has come to touch all the same. `neighbours` must cover
/// `needed`.
bool any_unseen_collision(const Rods& rods, const Box& box, const NeighbourList& neighbours, const Movement& movement);

/// The gap of contact `l` when the rods lie elsewhere: `centre` and `axis` replace those of `rods` (theory, eq. 3.4).
///
/// The contact's points follow their feature; a pair that has passed through itself counts as overlapping.
double gap_at(const Contacts& contacts, std::size_t l, const Rods& rods, const Box& box, std::span<const Vec3> centre,
              std::span<const Vec3> axis);

}  // namespace jostle
