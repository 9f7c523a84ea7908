#pragma once

#include <optional>
#include <string>

#include "jostle/rods/box.hpp"
#include "jostle/scene/scene.hpp"
#include "jostle/setup/anneal.hpp"

namespace jostle {

/// The rods of a scene before the first step, with ids 0, 1, 2, ...; a pure function of the scene (seed included).
///
/// "random":  centres and axes uniform, drawn anew where rods overlap; what still overlaps after 100 draws (1000 where
///            there are few rods) is annealed, all of it: `watch` sees how;
/// "aligned": centres uniform, all axes along `rods.axis`, pushed apart without turning;
/// "lattice": `rods_in_rows`;
/// "file":    `from_file`, checked for overlaps, and so is "run", up to `contact.overlap_limit`.
/// Ranks make the first two together, and all have all rods then.
/// Throws InputError where the rods do not fit, on all ranks; StoppedElsewhere where the watch of another has stopped.
Rods make_start(const Scene& scene, const Box& box, const std::optional<Rods>& from_file = std::nullopt,
                const AnnealingWatch& watch = {}, const Ranks& ranks = {});

/// Whether rods start at random places: "random" and "aligned".
bool places_are_drawn(const Scene& scene);

/// What a user has to know of the start of a scene whose passive rods are to come to equilibrium, at this volume
/// fraction: one sentence, or none.
std::string start_warning(const Scene& scene, double volume_fraction);

}  // namespace jostle
