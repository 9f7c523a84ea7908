#pragma once

#include <filesystem>
#include <optional>

#include "jostle/motion/self_propulsion.hpp"
#include "jostle/rods/box.hpp"
#include "jostle/simulation/scene.hpp"

namespace jostle {

/// Rods and box of a scene, before any step.
struct Beginning {
    Box box;
    Rods rods;
};

/// Reads the rods file of a scene with start = "file", if it has one; a relative path counts from the scene's folder.
std::optional<Rods> rods_from_file(const Scene& scene, const std::filesystem::path& scene_path);

/// The box of a scene, for these rods or, if there are none, for those that the scene describes.
Box box_of(const Scene& scene, const std::optional<Rods>& rods);

/// How rods swim. Errors: InputError, with the scene's name, where tumbles are too fast for the time step.
Swimming swimming_in_file(const Scene& scene, const std::filesystem::path& scene_path, const Rods& rods);

/// Makes the start of a scene. Errors: InputError where the rods do not fit.
Beginning beginning_of(const Scene& scene, const std::filesystem::path& scene_path);

}  // namespace jostle
