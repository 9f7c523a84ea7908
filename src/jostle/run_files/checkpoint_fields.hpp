#pragma once

#include <string_view>

#include "jostle/disk/named_fields.hpp"
#include "jostle/run_files/checkpoint.hpp"

namespace jostle {

/// A checkpoint as named fields. Holds views of it.
FieldWriter fields_of(const Checkpoint& checkpoint);

/// And back. Errors: std::out_of_range where a field is missing, unknown, or no such thing.
Checkpoint checkpoint_of_fields(std::string_view payload);

}  // namespace jostle
