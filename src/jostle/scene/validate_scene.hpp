#pragma once

#include <span>
#include <string>

#include "jostle/scene/scene.hpp"

namespace jostle {

/// Whether the values of a scene make sense, each alone and together; needs no file and allocates no rods.
///
/// Checks ranges, the box against the rods (`validate_box`, close packing, what a random start can reach), the mobility
/// model against L/D, and the times against each other. For start = "file" and "run" box, growth and contact.range are
/// checked by `validate_box`, `validate_growth` and `validate_contact_range`, once the file is read. Throws InputError
/// with key "table.name", value, allowed range and suggestion, and no place: of all keys that are wrong by themselves,
/// else of all that do not go together.
void validate(const Scene& scene);

/// Its second part: whether keys go together, as far as no table that has to do with it is `unsound`. Errors:
/// InputError of all that do not.
void require_fit_together(const Scene& scene, std::span<const std::string> unsound_tables);

/// Whether rods of `rods_volume` in all, none thicker than `largest_diameter`, can be in the box of the scene at all.
///
/// Throws InputError if an edge is shorter than the diameter or the volume fraction is not below 1.
void validate_box(const Scene& scene, double rods_volume, double largest_diameter);

/// Whether cells can divide at the scene's division length, the thickest of `largest_diameter`: no constraint without
/// growth. Daughters' diameter is that of their mother.
///
/// Throws InputError if two daughters need more, cells start as long, or daughters get too short for the mobility.
void validate_growth(const Scene& scene, double largest_diameter);

/// Whether `contact.range` is no more than the longest rod from end to end, `longest`, or the longest cell where they
/// grow: beyond, contacts of pairs that cannot touch within many steps fill the memory and take the time.
///
/// Throws InputError otherwise.
void validate_contact_range(const Scene& scene, double longest);

}  // namespace jostle
