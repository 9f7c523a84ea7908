#pragma once

#include "jostle/mobility/drag_mobility.hpp"
#include "jostle/rods/box.hpp"

namespace jostle {

struct OverlapRemovalResult {
    bool apart = false;    ///< no overlap is left
    double overlap = 0.0;  ///< the largest one left, a length
    int rounds = 0;        ///< contact problems solved
};

/// The drag of starts, that needs no fluid: unit drag, and the rotation that a thin rod of that drag would have, by
/// which its ends go as far as its centre does, or none.
DragLaw overlap_removal_drag(bool turning);

/// Moves overlapping rods until none overlaps, by contact forces alone: repeated contact problems without any known
/// motion.
///
/// Every round opens each overlap by at most a tenth of the thinnest diameter (the gap is linear only so far) and aims
/// at a hair of free space between touching rods. Gives up after 2000 rounds, or when numbers are no longer finite.
OverlapRemovalResult remove_overlaps(Rods& rods, const Box& box, const Mobility& mobility);

}  // namespace jostle
