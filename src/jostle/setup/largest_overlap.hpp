#pragma once

#include "jostle/rods/box.hpp"

namespace jostle {

/// The largest overlap of any two rods (or a rod and its own image), a length; 0 where none overlap.
double largest_overlap(const Rods& rods, const Box& box);

}  // namespace jostle
