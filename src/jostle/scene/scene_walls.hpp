#pragma once

#include <array>

#include "jostle/rods/walls.hpp"
#include "jostle/scene/scene.hpp"

namespace jostle {

/// The walls of the scene's box.
Walls scene_walls(const Scene& scene);

/// Directions in which walls end the box: faces, and those across a container.
std::array<bool, 3> walled_directions(const Scene& scene);

/// Whether the walls of a scene go together with its box and its rods, the longest (cylinder part) and thickest of
/// which are given; cells that grow get longer.
///
/// Throws InputError for walls across a periodic direction, walls across each other, a container that is not round,
/// rods that do not fit in between, and soft rods.
void validate_walls(const Scene& scene, double rods_volume, double longest, double thickest);

}  // namespace jostle
