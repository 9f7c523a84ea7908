#pragma once

#include "jostle/rods/box.hpp"
#include "jostle/rods/rods.hpp"
#include "jostle/scene/scene.hpp"

namespace jostle {

/// The rods of a scene with start = "lattice": rows along `rods.axis`, an edge of the box, at sites of the rectangular
/// grid that leaves them the most room. In a sphere or a tube the sites are those whose rods lie inside of it, of grids
/// about its middle. Vacant sites lie evenly among the others. Errors: InputError where the rods do not fit so.
Rods rods_in_rows(const Scene& scene, const Box& box);

/// Whether they do, if a scene has start = "lattice", without making them. Errors: InputError.
void require_lattice_fits(const Scene& scene, const Box& box);

}  // namespace jostle
