#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "jostle/motion/springs.hpp"
#include "jostle/rods/box.hpp"
#include "jostle/simulation/scene.hpp"
#include "jostle/stress/stress_field.hpp"

namespace jostle {

/// Rods and box of a scene, before any step.
struct Beginning {
    Box box;
    Rods rods;
    std::vector<Spring> springs;
};

/// Reads the rods file of a scene with start = "file", if it has one; a relative path counts from the scene's folder.
std::optional<Rods> rods_from_file(const Scene& scene, const std::filesystem::path& scene_path);

/// The box of a scene, for these rods or, if there are none, for those that the scene describes.
Box box_of(const Scene& scene, const std::optional<Rods>& rods);

/// The springs file of a scene, relative to the scene's folder.
std::string springs_path(const Scene& scene, const std::filesystem::path& scene_path);

/// The springs of a scene between these rods, empty where it names none; images are 0. Errors: InputError, DiskError.
std::vector<Spring> springs_from_file(const Scene& scene, const std::filesystem::path& scene_path, const Rods& rods);

/// `spring_relaxation`. Errors: InputError, with the scene's name, where springs are too stiff for the time step.
double slow_springs_in_file(const Scene& scene, const std::filesystem::path& scene_path,
                            std::span<const Spring> springs, const MobilityOfRod& mobility_of, double time_step);

/// The stress field of a scene. Errors: InputError, with the scene's name, where its cells are too many.
std::optional<StressField> field_in_file(const Scene& scene, const std::filesystem::path& scene_path, const Box& box);

/// Throws InputError, with the scene's name, where rods swim or tumble too fast for the time step.
void require_slow_swimmers_in_file(const Scene& scene, const std::filesystem::path& scene_path, const Rods& rods);

/// Makes the start of a scene. Errors: InputError where the rods do not fit.
Beginning beginning_of(const Scene& scene, const std::filesystem::path& scene_path);

}  // namespace jostle
