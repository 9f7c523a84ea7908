#pragma once

#include "jostle/mobility/mobility.hpp"
#include "jostle/rods/box.hpp"

namespace jostle {

struct PushApartResult {
    bool apart = false;    ///< no overlap is left
    double overlap = 0.0;  ///< the largest one left, a length
    int rounds = 0;        ///< contact problems solved
};

/// Moves overlapping rods until none overlaps, by contact forces alone: repeated contact problems without any known
/// motion.
///
/// Every round opens each overlap by at most a tenth of the thinnest diameter (the gap is linear only so far) and aims
/// at a hair of free space between touching rods. Gives up after 2000 rounds, or when numbers are no longer finite.
PushApartResult push_apart(Rods& rods, const Box& box, Mobility& mobility);

}  // namespace jostle
