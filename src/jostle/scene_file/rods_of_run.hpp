#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "jostle/rods/rods.hpp"
#include "jostle/rods/spring.hpp"
#include "jostle/scene/scene.hpp"

namespace jostle {

/// Counts the images of springs from rods whose own images are to count from 0: rows are ids.
void recount_images(std::vector<Spring>& springs, const Rods& rods);

/// What another run gives to a scene with start = "run".
struct RodsOfRun {
    Rods rods;                    ///< ids 0, 1, 2, ... in the order of those of the run; images 0, centres as they were
    std::vector<Spring> springs;  ///< that the run had, for these ids and images
    bool turned_round = false;    ///< rods reversed there, so that points of springs may be on their other sides
};

/// The rods of the run in the folder `rods.run`, which counts from the scene's folder: those of its checkpoint, to the
/// last bit, or of the frame `rods.frame`, in single precision. Swimmers keep their own speeds if
/// `motion.self_propulsion` and its deviation are those of the run. Errors: InputError for a folder that holds no run,
/// no such frame or other units; DiskError.
RodsOfRun rods_of_run(const Scene& scene, const std::filesystem::path& scene_path);

}  // namespace jostle
