#pragma once

#include <filesystem>
#include <optional>

#include "jostle/rods/box.hpp"
#include "jostle/simulation/scene.hpp"

/// Rods and box of a scene, before any step.
struct Beginning {
    jostle::Box box;
    jostle::Rods rods;
};

/// Reads the rods file of a scene with start = "file", if it has one; a relative path counts from the scene's folder.
std::optional<jostle::Rods> rods_from_file(const jostle::Scene& scene, const std::filesystem::path& scene_path);

/// The box of a scene, for these rods or, if there are none, for those that the scene describes.
jostle::Box box_of(const jostle::Scene& scene, const std::optional<jostle::Rods>& rods);

/// Throws InputError, with the scene's name, where tumbles are too fast for the time step.
void require_slow_tumbles_in_file(const jostle::Scene& scene, const std::filesystem::path& scene_path,
                                  const jostle::Rods& rods);

/// Makes the start of a scene. Errors: InputError where the rods do not fit.
Beginning beginning_of(const jostle::Scene& scene, const std::filesystem::path& scene_path);
