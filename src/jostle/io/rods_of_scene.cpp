#include "jostle/io/rods_of_scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "jostle/error/input_error.hpp"
#include "jostle/io/rods_file.hpp"
#include "jostle/io/springs_file.hpp"
#include "jostle/simulation/assemble.hpp"
#include "jostle/simulation/scene_box.hpp"
#include "jostle/simulation/start.hpp"
#include "jostle/simulation/step_limits.hpp"
#include "jostle/simulation/validate_scene.hpp"

namespace jostle {

namespace {

/// The keys that a file with the rods' own speeds needs, and does not go with.
void require_swimming(const Scene& scene, const std::string& file) {
    const auto refuse = [&](const char* key, double value, const char* problem, const char* suggestion) {
        throw InputError({.key = key,
                          .value = fmt::format("{}", value),
                          .problem = fmt::format("{}: {} has a column speed", problem, file),
                          .suggestion = suggestion});
    };
    const Scene::MotionTable& motion = scene.motion;
    if (motion.self_propulsion == 0.0)
        refuse("motion.self_propulsion", motion.self_propulsion, "says that nothing swims",
               "Set it to the mean speed, or remove the column");
    if (motion.self_propulsion_deviation != 0.0)
        refuse("motion.self_propulsion_deviation", motion.self_propulsion_deviation, "says that speeds are drawn",
               "Remove it, or the column");
}

}  // namespace

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
    if (!rods.speed.empty()) require_swimming(scene, file.string());
    validate_box(scene, total_volume(rods), *std::max_element(rods.diameter.begin(), rods.diameter.end()));
    return rods;
}

Box box_of(const Scene& scene, const std::optional<Rods>& rods) {
    const double volume = rods ? total_volume(*rods) : rods_volume(scene);
    return {box_edges(scene, volume), scene.box.periodic};
}

void require_slow_swimmers_in_file(const Scene& scene, const std::filesystem::path& scene_path, const Rods& rods) {
    try {
        require_slow_swimmers(scene, rods, time_step(scene, *make_mobility(scene, rods), rods));
    } catch (const InputError& error) {
        throw error.with_place({scene_path.string()});
    }
}

std::string springs_path(const Scene& scene, const std::filesystem::path& scene_path) {
    return (scene_path.parent_path() / scene.springs.file).string();
}

std::vector<Spring> springs_from_file(const Scene& scene, const std::filesystem::path& scene_path, const Rods& rods) {
    if (scene.springs.file.empty()) return {};
    std::vector<double> length(rods.size());  // by id: where nothing grows, ids are 0 to N - 1
    for (std::size_t i = 0; i < rods.size(); ++i) length.at(rods.id[i]) = rods.length[i];
    return read_springs(springs_path(scene, scene_path), rods.size(), [&](std::uint64_t id) { return length[id]; });
}

std::optional<StressField> field_in_file(const Scene& scene, const std::filesystem::path& scene_path, const Box& box) {
    try {
        return make_field(scene, box);
    } catch (const InputError& error) {
        throw error.with_place({scene_path.string()});
    }
}

double slow_springs_in_file(const Scene& scene, const std::filesystem::path& scene_path,
                            std::span<const Spring> springs, const MobilityOfRod& mobility_of, double time_step) {
    const double relaxation = spring_relaxation(springs, mobility_of, time_step);
    try {
        require_slow_springs(scene, relaxation, time_step);
    } catch (const InputError& error) {
        throw error.with_place({scene_path.string()});
    }
    return relaxation;
}

Beginning beginning_of(const Scene& scene, const std::filesystem::path& scene_path) {
    try {
        const auto from_file = rods_from_file(scene, scene_path);
        const Box box = box_of(scene, from_file);
        Beginning beginning = {box, make_start(scene, box, from_file), {}};
        require_slow_swimmers_in_file(scene, scene_path, beginning.rods);
        field_in_file(scene, scene_path, box);
        beginning.springs = springs_from_file(scene, scene_path, beginning.rods);
        hold_nearest_images(beginning.springs, beginning.rods, box);
        const auto mobility = make_mobility(scene, beginning.rods);
        slow_springs_in_file(
            scene, scene_path, beginning.springs,
            [&](std::uint64_t id) { return mobility->of_rod(id); },  // at the start rows are ids
            time_step(scene, *mobility, beginning.rods));
        return beginning;
    } catch (const InputError& error) {
        if (!error.parts().place.file.empty()) throw;
        throw error.with_place({scene_path.string()});
    }
}

}  // namespace jostle
