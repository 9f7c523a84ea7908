#include "jostle/scene_file/rods_of_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "jostle/disk/durable_file.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/error/one_line.hpp"
#include "jostle/run_files/checkpoint.hpp"
#include "jostle/scene/rod_size.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/scene_walls.hpp"
#include "jostle/scene/step_limits.hpp"
#include "jostle/scene/time_step.hpp"
#include "jostle/scene/validate_scene.hpp"
#include "jostle/scene_file/rods_file.hpp"
#include "jostle/scene_file/rods_of_run.hpp"
#include "jostle/scene_file/springs_file.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"

namespace jostle {

namespace {

constexpr double max_edges_away = 1e6;

/// The file that a key of the scene names, relative to the scene's folder. Errors: InputError if it is not there.
std::filesystem::path named_file(const char* key, const std::string& name, const std::filesystem::path& scene_path) {
    const std::filesystem::path file = scene_path.parent_path() / name;  // an absolute path replaces the folder
    if (file_exists(file.string())) return file;
    throw InputError(
        {.key = key,
         .value = "\"" + name + "\"",
         .problem = fmt::format("there is no such file: {}", on_one_line(file.string(), longest_file_name)),
         .suggestion = "Check the name, which counts from the scene's folder"});
}

/// The keys that a file with the rods' own speeds needs, and does not go with.
void require_swimming(const Scene& scene, const std::string& file) {
    const auto refuse = [&](const char* key, double value, const char* problem, const char* suggestion) {
        throw InputError({.key = key,
                          .value = fmt::format("{}", value),
                          .problem = fmt::format("{}: {} has a column speed", problem, file),
                          .suggestion = suggestion});
    };
    const Scene::MotionTable& motion = scene.motion;
    if (!swims(scene))
        refuse("motion.self_propulsion", motion.self_propulsion, "says that nothing swims",
               "Set it to the mean speed, or remove the column");
    if (motion.self_propulsion_deviation != 0.0)
        refuse("motion.self_propulsion_deviation", motion.self_propulsion_deviation, "says that speeds are drawn",
               "Remove it, or the column");
}

/// Tolerances are lengths in units of rods.diameter.
void require_diameter(const Scene& scene, const std::string& file, double thinnest, double thickest) {
    if (scene.rods.diameter >= thinnest && scene.rods.diameter <= thickest) return;
    throw InputError({.key = "rods.diameter",
                      .value = fmt::format("{}", scene.rods.diameter),
                      .problem = fmt::format("is no diameter of the rods in {}, and overlaps are judged by it", file),
                      .allowed = fmt::format("{} to {}", thinnest, thickest),
                      .suggestion = "Set it to the mean of the file's diameters"});
}

/// In two dimensions nothing would bring a rod back into the plane.
void require_in_plane(const Scene& scene, const Rods& rods, const std::string& giver) {
    for (std::size_t i = 0; dimensions_of(scene) == 2 && i < rods.size(); ++i)
        for (const auto& [name, value] : {std::pair{"z", rods.centre[i].z}, std::pair{"nz", rods.axis[i].z}})
            if (value != 0.0)
                throw InputError(
                    {.key = giver,
                     .value = fmt::format("rod {}", rods.id[i]),
                     .problem = fmt::format("lies out of the plane of box.dimensions = 2: {} = {:.6g}", name, value),
                     .allowed = "z = 0 and nz = 0"});
}

/// Of all rods, from end to end.
double longest_of(const Rods& rods) {
    double longest = 0.0;
    for (std::size_t i = 0; i < rods.size(); ++i) longest = std::max(longest, rods.length[i] + rods.diameter[i]);
    return longest;
}

/// Farther away, doubles would no longer tell where in the box a rod is.
void require_near(const Rods& rods, const Box& box, const std::string& file) {
    const double farthest = max_edges_away * box.longest_edge();
    for (std::size_t i = 0; i < rods.size(); ++i)
        for (int k = 0; k < 3; ++k)
            if (std::fabs(rods.centre[i][k]) > farthest)
                throw InputError(
                    {.key = file,
                     .value = fmt::format("rod {}", rods.id[i]),
                     .problem = fmt::format("lies far outside the box: {} = {}", "xyz"[k], rods.centre[i][k]),
                     .allowed = fmt::format("-{0:g} to {0:g}", farthest)});
}

}  // namespace

namespace {

/// Refuses rods that the scene does not fit, whoever gives them; `giver` in messages.
void require_fit(const Scene& scene, const Rods& rods, const std::string& giver) {
    require_drawn_speeds(scene, rods);
    if (scene.rods.count != 0 && scene.rods.count != rods.size())
        throw InputError({.key = "rods.count",
                          .value = std::to_string(scene.rods.count),
                          .problem = giver + " holds " + std::to_string(rods.size()) + " rods",
                          .suggestion = "Leave rods.count out to take all of them"});
    const auto [thinnest, thickest] = std::minmax_element(rods.diameter.begin(), rods.diameter.end());
    require_diameter(scene, giver, *thinnest, *thickest);
    require_in_plane(scene, rods, giver);
    const double volume = total_volume(rods, dimensions_of(scene));
    validate_box(scene, volume, *thickest);
    validate_walls(scene, volume, *std::max_element(rods.length.begin(), rods.length.end()), *thickest);
    validate_sheared_box(scene, volume, longest_of(rods));
    validate_growth(scene, *thickest);
    validate_contact_range(scene, longest_of(rods));
    require_near(rods, box_of(scene, rods), giver);
}

GivenRods given_by_run(const Scene& scene, const std::filesystem::path& scene_path) {
    RodsOfRun of_run = rods_of_run(scene, scene_path);
    require_fit(scene, of_run.rods, "the run " + (scene_path.parent_path() / scene.rods.run).string());
    GivenRods given{std::move(of_run.rods), {}};
    if (scene.springs.file.empty() || of_run.springs.empty()) return given;
    Checkpoint known;
    known.state.springs = std::move(of_run.springs);
    try {  // are they those of the file?
        require_same_springs(known, springs_from_file(scene, scene_path, given.rods, given.rods.size()),
                             of_run.turned_round, springs_path(scene, scene_path));
    } catch (const InputError&) {
        return given;
    }
    if (of_run.turned_round && (scene.rods.frame || scene.motion.reversal_rate == 0.0))
        throw InputError({.key = "springs.file",
                          .value = "\"" + scene.springs.file + "\"",
                          .problem =
                              "rods turned round in that run, and springs hold them on sides that only its last state, "
                              "and a run in which they still turn, tell",
                          .suggestion = "Leave rods.frame out, and keep motion.reversal_rate"});
    given.springs = std::move(known.state.springs);
    const Box box = box_of(scene, given.rods);
    for (std::size_t i = 0; i < given.rods.size(); ++i) box.wrap(given.rods.centre[i], given.rods.image[i]);
    recount_images(given.springs, given.rods);
    given.rods.image.assign(given.rods.size(), Image{0, 0, 0});
    return given;
}

}  // namespace

std::optional<GivenRods> given_rods(const Scene& scene, const std::filesystem::path& scene_path) {
    if (scene.rods.start == StartKind::run) return given_by_run(scene, scene_path);
    if (scene.rods.start != StartKind::file) return std::nullopt;
    const std::filesystem::path file = named_file("rods.file", scene.rods.file, scene_path);
    Rods rods = read_rods(file.string(), scene.rods.length, scene.rods.diameter, dimensions_of(scene));
    if (!rods.speed.empty()) require_swimming(scene, file.string());
    require_fit(scene, rods, "the file " + file.string());
    return GivenRods{std::move(rods), {}};
}

std::optional<Rods> rods_from_file(const Scene& scene, const std::filesystem::path& scene_path) {
    auto given = given_rods(scene, scene_path);
    return given ? std::optional(std::move(given->rods)) : std::nullopt;
}

Box box_of(const Scene& scene, const std::optional<Rods>& rods) {
    const double volume = rods ? total_volume(*rods, dimensions_of(scene)) : rods_volume(scene);
    return sheared_at_start(scene, {box_edges(scene, volume), box_periodic(scene), scene_walls(scene)});
}

std::shared_ptr<const Rods> fixed_rods(const Scene& scene, const std::filesystem::path& scene_path) {
    if (scene.rods.fixed.empty()) return nullptr;
    const std::filesystem::path file = named_file("rods.fixed", scene.rods.fixed, scene_path);
    Rods fixed = read_rods(file.string(), scene.rods.length, scene.rods.diameter, dimensions_of(scene));
    if (!fixed.speed.empty()) throw refused_file(file.string(), "fixed rods do not swim", "Remove the column speed");
    const Box box = box_of(scene, std::nullopt);
    require_near(fixed, box, file.string());
    for (std::size_t f = 0; f < fixed.size(); ++f) box.wrap(fixed.centre[f], fixed.image[f]);
    return std::make_shared<const Rods>(std::move(fixed));
}

std::string springs_path(const Scene& scene, const std::filesystem::path& scene_path) {
    return scene.springs.file.empty() ? "" : named_file("springs.file", scene.springs.file, scene_path).string();
}

std::vector<Spring> springs_from_file(const Scene& scene, const std::filesystem::path& scene_path, const Rods& rods,
                                      std::uint64_t count) {
    if (scene.springs.file.empty()) return {};
    std::vector<double> length(rods.size());  // by id: where nothing grows, ids are 0 to N - 1
    for (std::size_t i = 0; i < rods.size(); ++i) length.at(rods.id[i]) = rods.length[i];
    return read_springs(springs_path(scene, scene_path), count,
                        [&](std::uint64_t id) { return length[length.size() == 1 ? 0 : id]; });
}

namespace {

Beginning beginning_from(const Scene& scene, const std::filesystem::path& scene_path, std::optional<GivenRods> given,
                         const AnnealingWatch& watch, const StartMaker& make) {
    std::optional<Rods> from_file;
    if (given) from_file = std::move(given->rods);
    const Box box = box_of(scene, from_file).with_fixed_rods(fixed_rods(scene, scene_path));
    Beginning beginning = {{box, {}}};
    const Rods rods = from_file ? *from_file : representative_rods(scene);
    std::vector<Spring>& springs = beginning.state.springs;
    const bool held = given && !given->springs.empty();  // by images that they know
    springs = held ? std::move(given->springs)
                   : springs_from_file(scene, scene_path, rods, from_file ? rods.size() : scene.rods.count);
    const auto model = make_mobility(scene);
    const double step = time_step(scene, *model, box, rods, springs);
    require_countable_steps(scene, step);
    require_short_step(step_limits(scene, *model, box, rods, springs), step);
    make_field(scene, box);  // for what it refuses
    const AnnealingWatch see = [&](const Annealing& now) {
        beginning.annealing = now;
        if (watch) watch(now);
    };
    beginning.state.rods = make ? make(box, from_file, see) : make_start(scene, box, from_file, see);
    if (!held) hold_nearest_images(springs, beginning.state.rods, box);
    return beginning;
}

}  // namespace

Beginning beginning_of(const Scene& scene, const std::filesystem::path& scene_path, const AnnealingWatch& watch,
                       const StartMaker& make) {
    return in_scene_file(scene_path,
                         [&] { return beginning_from(scene, scene_path, given_rods(scene, scene_path), watch, make); });
}

Beginning beginning_of(const Scene& scene, Rods rods) {
    if (!rods.speed.empty()) require_swimming(scene, "what is given");
    require_fit(scene, rods, "what is given");
    return beginning_from(scene, {}, GivenRods{std::move(rods), {}}, {}, {});
}

}  // namespace jostle
