#include "jostle/scene_file/rods_of_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "jostle/disk/durable_file.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/motion/self_propulsion.hpp"
#include "jostle/rods/space_filling_order.hpp"
#include "jostle/run_files/checkpoint.hpp"
#include "jostle/run_files/trajectory_journal.hpp"
#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene_file/same_scene.hpp"

namespace jostle {

namespace {

[[noreturn]] void refuse_run(const Scene& scene, std::string problem, std::string suggestion) {
    throw InputError({.key = "rods.run",
                      .value = "\"" + scene.rods.run + "\"",
                      .problem = std::move(problem),
                      .suggestion = std::move(suggestion)});
}

Checkpoint last_state(const Scene& scene, const std::string& folder) {
    if (!file_exists(folder))
        refuse_run(scene, "there is no such folder", "Check the name, which counts from the scene's folder");
    auto checkpoint = latest_checkpoint(folder);
    if (!checkpoint)
        refuse_run(scene, "is not the folder of a run: it holds no checkpoint",
                   "Give the folder that `jostle run` named");
    return std::move(*checkpoint);
}

/// Of the journal, which every run with frames keeps.
TrajectoryFrame frame_of(const Scene& scene, const std::string& folder) {
    const std::string journal = folder + "/" + trajectory_journal_name;
    const std::uint64_t wanted = *scene.rods.frame;
    std::uint64_t frames = 0;
    TrajectoryFrame frame;
    if (file_exists(journal))
        for (TrajectoryReader reader(journal); reader.next(frame); ++frames)
            if (frames == wanted) return frame;
    throw InputError({.key = "rods.frame",
                      .value = std::to_string(wanted),
                      .problem = frames == 0 ? "the run has no frames" : "the run has no such frame",
                      .allowed = frames == 0 ? "" : fmt::format("0 to {}", frames - 1),
                      .suggestion = "Leave frame out to take the last state"});
}

Vec3 vector_of(const std::array<float, 3>& single) {
    return {single[0], single[1], single[2]};
}

/// Rods of a frame; sizes and speeds, which single precision has rounded or lacks, as the checkpoint knows them.
Rods rods_of_frame(const TrajectoryFrame& frame, const Rods& last) {
    std::unordered_map<std::uint64_t, std::size_t> row_of;
    for (std::size_t i = 0; i < last.size(); ++i) row_of[last.id[i]] = i;
    const auto exact = [&](float single, const std::vector<double>& known, std::uint64_t id) {
        const auto row = row_of.find(id);
        if (row != row_of.end() && static_cast<float>(known[row->second]) == single) return known[row->second];
        return static_cast<double>(single);
    };
    Rods rods;
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const std::uint64_t id = frame.id[i];
        rods.push_back(id, vector_of(frame.centre[i]), normalised(vector_of(frame.axis[i])),
                       exact(frame.length[i], last.length, id), exact(frame.diameter[i], last.diameter, id));
        rods.image.back() = frame.image[i];
        if (last.speed.empty()) continue;
        const auto row = row_of.find(id);
        rods.speed.push_back(row == row_of.end() ? 0.0 : last.speed[row->second]);
    }
    return rods;
}

/// Whether swimmers of the scene swim as those of the run do.
bool swims_alike(const Scene& scene, const Scene& there) {
    return scene.schedule.self_propulsion.empty() && there.schedule.self_propulsion.empty() &&
           scene.motion.self_propulsion == there.motion.self_propulsion &&
           scene.motion.self_propulsion_deviation == there.motion.self_propulsion_deviation;
}

/// Rods across the face of a sheared box would be thrown onto others in one that is sheared otherwise.
void require_sheared_alike(const Scene& scene, const Box& there) {
    const double edge = there.edges().x;
    const double strain = has_flow(scene) ? scene.flow.start_strain : 0.0;
    if (std::fabs(std::remainder(strain * there.edges().y - there.offset(), edge)) <= 1e-6 * edge) return;
    throw InputError(
        {.key = "flow.start_strain",
         .value = fmt::format("{}", strain),
         .problem = "is not the strain of the box that the rods come from, " + scene.rods.run,
         .allowed = fmt::format("{}, or whole edges along x over edges along y more",
                                (there.offset() < 0.0 ? there.offset() + edge : there.offset()) / there.edges().y),
         .suggestion = "Set it under [flow]"});
}

/// Springs for rods whose images count from 0, by their new ids.
std::vector<Spring> renumbered(std::vector<Spring> springs, const Rods& rods) {
    std::unordered_map<std::uint64_t, std::size_t> place;
    for (std::size_t i = 0; i < rods.size(); ++i) place[rods.id[i]] = i;
    for (Spring& spring : springs) {
        spring.rod_1 = place.at(spring.rod_1);
        spring.rod_2 = place.at(spring.rod_2);
    }
    recount_images(springs, rods);
    return springs;
}

}  // namespace

void recount_images(std::vector<Spring>& springs, const Rods& rods) {
    for (Spring& spring : springs)
        for (std::size_t k = 0; k < 3; ++k)
            spring.image[k] += rods.image[spring.rod_2][k] - rods.image[spring.rod_1][k];
}

RodsOfRun rods_of_run(const Scene& scene, const std::filesystem::path& scene_path) {
    const std::string folder = (scene_path.parent_path() / scene.rods.run).string();
    Checkpoint last = last_state(scene, folder);
    const Scene there = scene_of(last, folder);
    if (there.units.system != scene.units.system)
        refuse_run(scene, "is a run in other units", "Set units.system as that run has it");
    const bool keeps_speeds = scene.motion.self_propulsion != 0.0 && swims_alike(scene, there);
    if (keeps_speeds && last.state.rods.speed.empty() && there.motion.self_propulsion_deviation > 0.0 && !grows(there))
        last.state.rods.speed = SelfPropulsion(swimming_of(there)).speeds(last.state.rods, there.seed);
    if (!keeps_speeds) last.state.rods.speed.clear();
    Rods rods =
        in_order_of_ids(scene.rods.frame ? rods_of_frame(frame_of(scene, folder), last.state.rods) : last.state.rods);
    if (rods.size() == 0) refuse_run(scene, "has no rods left", "Give an earlier frame");
    require_sheared_alike(scene, scene.rods.frame ? frame_of(scene, folder).box : last.state.box);
    RodsOfRun found;
    found.springs = renumbered(std::move(last.state.springs), rods);
    found.turned_round = there.motion.reversal_rate > 0.0;
    std::iota(rods.id.begin(), rods.id.end(), std::uint64_t{0});
    rods.image.assign(rods.size(), Image{0, 0, 0});
    rods.cycle.clear();
    rods.founder_bits = 0;
    found.rods = std::move(rods);
    return found;
}

}  // namespace jostle
