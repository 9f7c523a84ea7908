#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "jostle/contact_problem/contact_groups.hpp"
#include "jostle/contact_problem/delassus_operator.hpp"
#include "jostle/domain/domain.hpp"

namespace jostle {

/// What `borrow_contacts` adds to a rank's problem, beside what it does to the colours.
struct Borrowed {
    std::vector<MobileRod> rods;  ///< other ranks' rods that are no local rods here: their local indices follow
    BorderMessages all_messages;  ///< velocities of all other ranks' rods that pairs here have
};

/// Borrows contacts that are solved here although both rods are other ranks': where ranks exchange velocities less
/// often than once a colour.
///
/// Some colours that follow each other are a phase. It begins with the velocities of the other ranks' rods that its
/// pairs share. A pair of a later colour in the phase needs the velocity that such a rod has then: so all pairs of that
/// rod of earlier colours in the phase are solved here, too, and for those the same is needed of their other rods, and
/// so on. A rank is told of these pairs as they are, forces and what the last sweep changed of them included. It makes
/// of them what the ranks make that have their rods: the same bits by the same arithmetic.
///
/// Fills `borrowed` and `messages` of the colours anew. All ranks call it together, when all have made the same sweeps.
template <class Real>
Borrowed borrow_contacts(const Domain& domain, const DelassusOperator& matrix, std::span<ColourContacts<Real>> colours,
                         std::size_t colours_per_phase);

extern template Borrowed borrow_contacts(const Domain&, const DelassusOperator&, std::span<ColourContacts<float>>,
                                         std::size_t);
extern template Borrowed borrow_contacts(const Domain&, const DelassusOperator&, std::span<ColourContacts<double>>,
                                         std::size_t);

}  // namespace jostle
