#include "jostle/simulation/unused_keys.hpp"

#include <fmt/core.h>

#include <array>

#include "jostle/simulation/refusal.hpp"
#include "jostle/simulation/scene_keys.hpp"

namespace jostle {

namespace {

struct MotionValue {
    const char* key;
    double given;  ///< 0 by default
};

/// The keys of swimmers, which mean nothing where nothing swims.
std::array<MotionValue, 5> motion_values(const Scene& scene) {
    const Scene::MotionTable& motion = scene.motion;
    return {{{"motion.self_propulsion_deviation", motion.self_propulsion_deviation},
             {"motion.tumble_rate", motion.tumble_rate},
             {"motion.tumble_time", motion.tumble_time.value_or(0.0)},
             {"motion.reversal_rate", motion.reversal_rate},
             {"output.active_stress_lag", scene.output.active_stress_lag.value_or(0.0)}}};
}

}  // namespace

std::vector<UnusedKey> unused_keys(const Scene& scene) {
    std::vector<UnusedKey> unused;
    const StartKind start = scene.rods.start;
    const std::string with = fmt::format("is not used with rods.start = \"{}\"", word_of(start));
    if (scene.box.edges)
        unused.push_back({"box.shape", "is not used with box.edges, which give the shape", "Remove shape or edges"});
    if (start == StartKind::file)
        for (const char* key : {"rods.length_deviation", "rods.diameter_deviation"})
            unused.push_back(
                {key, with + ": the file tells", "Give the file columns length and diameter, or remove it"});
    if (start != StartKind::file) unused.push_back({"rods.file", with, "Set start = \"file\", or remove file"});
    if (start != StartKind::aligned && start != StartKind::lattice)
        unused.push_back({"rods.axis", with, "Set start = \"aligned\", or remove axis"});
    if (scene.motion.self_propulsion == 0.0)
        for (const MotionValue& value : motion_values(scene))
            unused.push_back({value.key, "is not used with motion.self_propulsion = 0: nothing swims",
                              "Set self_propulsion, or remove it"});
    else if (scene.motion.tumble_rate == 0.0)
        unused.push_back({"motion.tumble_time", "is not used with motion.tumble_rate = 0",
                          "Set tumble_rate, or remove tumble_time"});
    const bool soft = scene.contact.model == ContactModel::wca;
    const std::string with_model = fmt::format("is not used with contact.model = \"{}\"", word_of(scene.contact.model));
    if (!soft) unused.push_back({"contact.energy", with_model, "Set model = \"wca\", or remove energy"});
    if (soft)
        for (const char* key : {"contact.brownian_correction", "contact.range", "solver.method", "solver.warm_start",
                                "solver.step_rule", "solver.residual", "solver.tolerance", "solver.max_iterations"})
            unused.push_back({key, with_model + ": there is no contact problem", "Remove it"});
    if (scene.growth.rate == 0.0)
        for (const char* key :
             {"growth.rate_deviation", "growth.division", "growth.division_length", "growth.division_deviation",
              "growth.daughters", "growth.stall_force", "growth.death_rate", "growth.division_every"})
            unused.push_back({key, "is not used without growth.rate", "Add rate under [growth], or remove it"});
    if (scene.output.trajectory_every == 0)
        unused.push_back({"output.stress_per_rod", "is not used without output.trajectory_every: there are no frames",
                          "Set trajectory_every, or remove it"});
    if (scene.output.field_every == 0)
        unused.push_back({"output.field_spacing", "is not used without output.field_every: there is no field",
                          "Set field_every, or remove it"});
    if (scene.springs.file.empty())
        unused.push_back({"springs.file", "names no file", "Name a CSV file of springs, or remove [springs]"});
    if (start == StartKind::file && scene.rods.count == 0)
        unused.push_back({"rods.count", with + ": the file tells", "Remove count"});
    return unused;
}

void refuse_unused_keys(const Scene& scene) {
    const Scene defaults;
    for (const UnusedKey& unused : unused_keys(scene)) {
        std::string value;
        if (unused.key == "rods.file") value = scene.rods.file;
        if (unused.key == "rods.axis" && !(scene.rods.axis == defaults.rods.axis)) value = text(scene.rods.axis);
        if (unused.key == "rods.length_deviation" && scene.rods.length_deviation != 0.0)
            value = text(scene.rods.length_deviation);
        if (unused.key == "rods.diameter_deviation" && scene.rods.diameter_deviation != 0.0)
            value = text(scene.rods.diameter_deviation);
        if (unused.key == "output.field_spacing" && scene.output.field_spacing)
            value = text(*scene.output.field_spacing);
        if (unused.key == "output.stress_per_rod" && scene.output.stress_per_rod) value = "true";
        if (unused.key == "contact.energy" && scene.contact.energy) value = text(*scene.contact.energy);
        if (unused.key == "contact.range" && scene.contact.range) value = text(*scene.contact.range);
        for (const auto& [key, given] : motion_values(scene))
            if (unused.key == key && given != 0.0) value = text(given);
        if (unused.key == "box.shape" && !(scene.box.shape == defaults.box.shape)) value = text(scene.box.shape);
        if (!value.empty()) refuse(unused.key, value, unused.reason, "", unused.suggestion);
    }
}

}  // namespace jostle
