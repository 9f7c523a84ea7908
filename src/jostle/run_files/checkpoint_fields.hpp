#pragma once

#include <string_view>

#include "jostle/disk/named_fields.hpp"
#include "jostle/domain/rods_in_order.hpp"
#include "jostle/run_files/checkpoint.hpp"

namespace jostle {

/// A checkpoint as named fields, with these rods in the place of its own. Holds views of both. Where ranks share the
/// rods, all write the fields together, and the first gets them.
FieldWriter fields_of(const Checkpoint& checkpoint, const RodsInOrder& rods);

/// And back. Errors: std::out_of_range where a field is missing, unknown, or no such thing.
Checkpoint checkpoint_of_fields(std::string_view payload);

}  // namespace jostle
