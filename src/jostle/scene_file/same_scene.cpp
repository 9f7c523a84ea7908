#include "jostle/scene_file/same_scene.hpp"

#include "jostle/disk/durable_file.hpp"
#include "jostle/scene/key_values.hpp"
#include "jostle/scene_file/scene_reader.hpp"

namespace jostle {

Scene scene_of(const Checkpoint& checkpoint, const std::string& folder) {
    return parse_scene(checkpoint.scene, folder + "/checkpoint");
}

void require_same_scene(const Checkpoint& checkpoint, const Scene& scene, const std::string& folder) {
    const std::string difference = physics_difference(scene_of(checkpoint, folder), scene);
    if (difference.empty()) return;
    throw refused_file(folder + "/checkpoint", "the checkpoint is of another scene: " + difference,
                       "Restore the scene, give another folder with --out, or start again with --fresh");
}

}  // namespace jostle
