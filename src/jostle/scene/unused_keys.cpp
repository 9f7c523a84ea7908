#include "jostle/scene/unused_keys.hpp"

#include <fmt/core.h>

#include "jostle/error/refuse.hpp"
#include "jostle/scene/key_values.hpp"
#include "jostle/scene/mistakes.hpp"
#include "jostle/scene/scene_keys.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/scene_walls.hpp"

namespace jostle {

namespace {

using List = std::vector<UnusedKey>;

std::string with_start(const Scene& scene) {
    return fmt::format("is not used with rods.start = \"{}\"", word_of(scene.rods.start));
}

void add_of_box(const Scene& scene, List& unused) {
    const bool flat = dimensions_of(scene) == 2;
    for (const char* table : {"box.", "schedule."})
        unused.push_back({std::string(table) + (flat ? "volume_fraction" : "area_fraction"),
                          flat ? "is not used with box.dimensions = 2: what rods fill is an area"
                               : "is not used without box.dimensions = 2",
                          flat ? "Write area_fraction" : "Write volume_fraction, or set box.dimensions = 2"});
    if (scene.box.edges)
        unused.push_back({"box.shape", "is not used with box.edges, which give the shape", "Remove shape or edges"});
}

void add_of_start(const Scene& scene, List& unused) {
    const StartKind start = scene.rods.start;
    const std::string with = with_start(scene);
    if (start == StartKind::file)
        for (const char* key : {"rods.length_deviation", "rods.diameter_deviation"})
            unused.push_back(
                {key, with + ": the file tells", "Give the file columns length and diameter, or remove it"});
    if (start == StartKind::run)
        for (const char* key : {"rods.length_deviation", "rods.diameter_deviation"})
            unused.push_back({key, with + ": rods keep their sizes", "Remove it"});
    if (start != StartKind::run)
        for (const char* key : {"rods.run", "rods.frame"})
            unused.push_back(
                {key, with, fmt::format("Set start = \"run\", or remove {}", std::string_view(key).substr(5))});
    if (start != StartKind::file) unused.push_back({"rods.file", with, "Set start = \"file\", or remove file"});
    if (start != StartKind::aligned && start != StartKind::lattice)
        unused.push_back({"rods.axis", with, "Set start = \"aligned\", or remove axis"});
}

void add_of_walls(const Scene& scene, List& unused) {
    if (dimensions_of(scene) == 2)
        unused.push_back({"walls.axis", "is not used with box.dimensions = 2: a tube is a disc", "Remove axis"});
    else if (scene.walls.container != Container::tube)
        unused.push_back({"walls.axis", "is not used without a tube", "Set container = \"tube\", or remove axis"});
    if (!scene_walls(scene).any())
        unused.push_back({"walls.torque", "is not used without walls", "Set faces or container, or remove torque"});
}

void add_of_forces(const Scene& scene, List& unused) {
    if (scene.forces.on_rods == Vec3{})
        unused.push_back({"forces.drift", "is not used without a force on the rods", "Set on_rods, or remove drift"});
    if (scene.forces.alignment_energy == 0.0)
        unused.push_back({"forces.alignment_axis", "is not used with forces.alignment_energy = 0",
                          "Set alignment_energy, or remove alignment_axis"});
}

void add_of_motion(const Scene& scene, List& unused) {
    if (!swims(scene))
        for (const char* key : {"motion.self_propulsion_deviation", "motion.tumble_rate", "motion.tumble_time",
                                "motion.reversal_rate", "motion.force_dipole", "output.active_stress_lag"})
            unused.push_back({key, "is not used with motion.self_propulsion = 0: nothing swims",
                              "Set self_propulsion, or remove it"});
    else if (scene.motion.tumble_rate == 0.0)
        unused.push_back({"motion.tumble_time", "is not used with motion.tumble_rate = 0",
                          "Set tumble_rate, or remove tumble_time"});
}

void add_of_fluid(const Scene& scene, List& unused) {
    if (scene.mobility.model != MobilityModel::hydrodynamic)
        for (const char* key : {"mobility.tolerance", "mobility.cutoff", "motion.force_dipole"})
            unused.push_back({key,
                              fmt::format("is not used with mobility.model = \"{}\"", word_of(scene.mobility.model)),
                              "Set model = \"hydrodynamic\", or remove it"});
    if (scene.flow.strain_amplitude == 0.0)
        unused.push_back({"flow.frequency", "is not used with flow.strain_amplitude = 0: nothing goes to and fro",
                          "Set strain_amplitude, or remove frequency"});
}

void add_of_contacts(const Scene& scene, List& unused) {
    const bool soft = scene.contact.model == ContactModel::wca;
    const std::string with_model = fmt::format("is not used with contact.model = \"{}\"", word_of(scene.contact.model));
    if (!soft) unused.push_back({"contact.energy", with_model, "Set model = \"wca\", or remove energy"});
    if (soft)
        for (const char* key : {"contact.brownian_correction", "contact.range", "solver.method", "solver.warm_start",
                                "solver.step_rule", "solver.residual", "solver.tolerance", "solver.max_iterations"})
            unused.push_back({key, with_model + ": there is no contact problem", "Remove it"});
}

void add_of_growth(const Scene& scene, List& unused) {
    if (scene.growth.rate == 0.0)  // one that is no rate is refused for itself
        for (const char* key : {"growth.rate_deviation", "growth.division", "growth.division_length",
                                "growth.division_deviation", "growth.daughters", "growth.stall_force",
                                "growth.stall_memory", "growth.death_rate", "growth.division_every"})
            unused.push_back({key, "is not used without growth.rate", "Add rate under [growth], or remove it"});
    else if (!scene.growth.stall_force)
        unused.push_back({"growth.stall_memory", "is not used without growth.stall_force: nothing stalls",
                          "Set stall_force, or remove stall_memory"});
}

void add_of_schedule_and_output(const Scene& scene, List& unused) {
    if (!scene.motion.brownian)
        unused.push_back({"schedule.kT", "is not used with motion.brownian = false", "Remove one of the two"});
    if (scene.output.trajectory_every == 0)
        for (const char* key : {"output.stress_per_rod", "output.trajectory_times"})
            unused.push_back({key, "is not used with output.trajectory_every = 0: there are no frames",
                              "Set trajectory_every = \"auto\", or remove it"});
    if (scene.output.field_every == 0)
        unused.push_back({"output.field_spacing", "is not used without output.field_every: there is no field",
                          "Set field_every, or remove it"});
}

void add_of_time_and_pressure(const Scene& scene, List& unused) {
    if (scene.time.rms_step && !scene.time.step)
        unused.push_back({"time.step", "is not used with time.rms_step", "Remove one of the two"});
    if (!scene.pressure.external)
        for (const char* key : {"pressure.coupling", "pressure.relaxation_time", "pressure.limit_volume_fraction"})
            unused.push_back(
                {key, "is not used without pressure.external: the volume stays", "Set external, or remove it"});
}

void add_of_files(const Scene& scene, List& unused) {
    if (scene.rods.fixed.empty())
        unused.push_back({"rods.fixed", "names no file", "Name a CSV file of rods that do not move, or remove fixed"});
    if (scene.springs.file.empty())
        unused.push_back({"springs.file", "names no file", "Name a CSV file of springs, or remove [springs]"});
    if (rods_are_given(scene) && scene.rods.count == 0)
        unused.push_back({"rods.count", with_start(scene) + ", which tells it", "Remove count"});
}

}  // namespace

std::vector<UnusedKey> unused_keys(const Scene& scene) {
    std::vector<UnusedKey> unused;
    for (const auto add :
         {add_of_box, add_of_start, add_of_walls, add_of_forces, add_of_motion, add_of_fluid, add_of_contacts,
          add_of_growth, add_of_schedule_and_output, add_of_time_and_pressure, add_of_files})
        add(scene, unused);
    return unused;
}

void refuse_unused_keys(const Scene& scene) {
    Scene untouched;
    untouched.box.dimensions = scene.box.dimensions;
    leave_out_z(untouched);
    const auto values = key_values(scene), defaults = key_values(untouched);
    Mistakes mistakes;
    for (const UnusedKey& unused : unused_keys(scene))
        for (std::size_t k = 0; k < values.size(); ++k)
            if (values[k].key == unused.key && values[k].text != defaults[k].text)
                mistakes.add(InputError({unused.key, values[k].text, unused.reason, "", unused.suggestion}));
    mistakes.refuse_any();
}

}  // namespace jostle
