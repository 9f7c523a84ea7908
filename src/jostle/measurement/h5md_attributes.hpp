#pragma once

#include "jostle/run_files/h5md_writer.hpp"
#include "jostle/scene/scene.hpp"

namespace jostle {

/// What a trajectory tells of a scene: version, seed, units and kT; texts and the command are left to the caller.
H5mdAttributes h5md_attributes(const Scene& scene);

}  // namespace jostle
