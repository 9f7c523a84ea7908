#include "jostle/io/rods_of_scene.hpp"

#include <algorithm>

#include "jostle/error/input_error.hpp"
#include "jostle/io/rods_file.hpp"
#include "jostle/simulation/assemble.hpp"
#include "jostle/simulation/start.hpp"
#include "jostle/simulation/validate_scene.hpp"

namespace jostle {

std::optional<Rods> rods_from_file(const Scene& scene, const std::filesystem::path& scene_path) {
    if (scene.rods.start != StartKind::file) return std::nullopt;
    const std::filesystem::path file =
        scene_path.parent_path() / scene.rods.file;  // an absolute path replaces the folder
    Rods rods = read_rods(file.string(), scene.rods.length, scene.rods.diameter);
    if (scene.rods.count != 0 && scene.rods.count != rods.size())
        throw InputError({.key = "rods.count",
                          .value = std::to_string(scene.rods.count),
                          .problem = "the file " + file.string() + " holds " + std::to_string(rods.size()) + " rods",
                          .suggestion = "Leave rods.count out to take all of the file",
                          .place = {scene_path.string()}});
    validate_box(scene, total_volume(rods), *std::max_element(rods.diameter.begin(), rods.diameter.end()));
    return rods;
}

Box box_of(const Scene& scene, const std::optional<Rods>& rods) {
    const double volume = rods ? total_volume(*rods) : rods_volume(scene);
    return {box_edges(scene, volume), scene.box.periodic};
}

Swimming swimming_in_file(const Scene& scene, const std::filesystem::path& scene_path, const Rods& rods) {
    try {
        return swimming_of(scene, rods, time_step(scene, *make_mobility(scene, rods), rods));
    } catch (const InputError& error) {
        throw error.with_place({scene_path.string()});
    }
}

Beginning beginning_of(const Scene& scene, const std::filesystem::path& scene_path) {
    try {
        const auto from_file = rods_from_file(scene, scene_path);
        const Box box = box_of(scene, from_file);
        Beginning beginning = {box, make_start(scene, box, from_file)};
        swimming_in_file(scene, scene_path, beginning.rods);
        return beginning;
    } catch (const InputError& error) {
        if (!error.parts().place.file.empty()) throw;
        throw error.with_place({scene_path.string()});
    }
}

}  // namespace jostle
