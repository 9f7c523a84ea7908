#include "jostle/scene/scene_flow.hpp"

#include <fmt/core.h>

#include <numbers>

#include "jostle/error/refuse.hpp"
#include "jostle/scene/key_values.hpp"
#include "jostle/scene/number_text.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/schedule.hpp"

namespace jostle {

namespace {

/// The key that makes a scene one with flow, and its value.
std::pair<const char*, double> first_key(const Scene& scene) {
    if (scene.flow.shear_rate != 0.0) return {"flow.shear_rate", scene.flow.shear_rate};
    if (scene.flow.strain_amplitude != 0.0) return {"flow.strain_amplitude", scene.flow.strain_amplitude};
    return {"flow.start_strain", scene.flow.start_strain};
}

void check_one_flow(const Scene& scene) {
    const Scene::FlowTable& flow = scene.flow;
    if (flow.shear_rate != 0.0 && flow.strain_amplitude != 0.0)
        refuse("flow.strain_amplitude", text(flow.strain_amplitude),
               fmt::format("is given beside flow.shear_rate = {}", flow.shear_rate), "one of the two, not both",
               "Keep shear_rate for a steady flow, or strain_amplitude and frequency for one to and fro");
    if (flow.strain_amplitude != 0.0 && flow.frequency == 0.0)
        refuse("flow.frequency", "", "is missing: strain_amplitude needs it", "periods in a unit of time, above 0",
               "Add frequency under [flow]");
}

void check_motion_in_flow(const Scene& scene, const char* key, const std::string& value) {
    if (grows(scene))
        refuse(key, value, "shears rods that stay, and with growth.rate cells divide and die", "no flow, or no growth",
               "Remove [flow] or [growth]");
    if (swims(scene))
        refuse(key, value, "is given with motion.self_propulsion: active stress in a flow is not known yet",
               "no flow, or no swimmers", "Remove [flow] or self_propulsion");
    if (scene.forces.on_rods != Vec3{})
        refuse(key, value, "is given with forces.on_rods: forces from outside have not been tried in a flow",
               "one of the two, not both", "Remove [flow] or [forces]");
    if (has_torques(scene))
        refuse(key, value, "is given with forces.alignment_energy: forces from outside have not been tried in a flow",
               "one of the two, not both", "Remove [flow] or [forces]");
    if (!scene.rods.fixed.empty())
        refuse(key, value, "is given with rods.fixed: rods that stay would be copied to where the flow takes copies",
               "one of the two, not both", "Remove [flow] or fixed");
    if (scene.mobility.model == MobilityModel::hydrodynamic)
        refuse(key, value, "is given with mobility.model = \"hydrodynamic\", which knows no flow from outside", "",
               "Use mobility.model = \"capsule\"");
    if (squeezes_box(scene))
        refuse(key_of_box_ramp(scene), "", fmt::format("changes the box while {} shears it", key),
               "one of the two, not both", "Remove [flow], or the key");
}

}  // namespace

bool has_flow(const Scene& scene) {
    return flows(scene) || scene.flow.start_strain != 0.0;
}

bool flows(const Scene& scene) {
    return scene.flow.shear_rate != 0.0 || oscillates(scene);
}

bool oscillates(const Scene& scene) {
    return scene.flow.strain_amplitude != 0.0;
}

ShearFlow flow_of(const Scene& scene) {
    const Scene::FlowTable& flow = scene.flow;
    return {flow.shear_rate, flow.strain_amplitude, 2.0 * std::numbers::pi * flow.frequency, flow.start_strain};
}

Box sheared_at_start(const Scene& scene, const Box& box) {
    return has_flow(scene) ? box.sheared(scene.flow.start_strain * box.edges().y) : box;
}

void validate_flow(const Scene& scene) {
    check_one_flow(scene);
    if (!has_flow(scene)) return;
    const auto [key, number] = first_key(scene);
    const std::string value = text(number);
    const auto& periodic = scene.box.periodic;
    if (!periodic[0] || !periodic[1])
        refuse("box.periodic", text(periodic),
               fmt::format("ends the box along x or y, and {} shears it along x, with the gradient along y", key),
               fmt::format("[true, true, {}]", periodic[2]),
               "Put planes across z alone (walls.faces); they have no friction, so no wall could drive a flow");
    check_motion_in_flow(scene, key, value);
}

void validate_sheared_box(const Scene& scene, double rods_volume, double longest) {
    if (!has_flow(scene)) return;
    const Vec3 edges = box_edges(scene, rods_volume);
    const bool given = scene.box.edges.has_value();
    for (const int k : {0, 1})
        if (!(edges[k] >= 2.0 * longest))
            refuse(given ? "box.edges" : "box.volume_fraction", given ? text(edges) : text(*scene.box.volume_fraction),
                   fmt::format("makes edge {} {} long, so that rods that measure {} from end to end could meet their "
                               "own sheared copies",
                               "xy"[k], rounded(edges[k]), rounded(longest)),
                   fmt::format("edges along x and y of at least {}", rounded(2.0 * longest)),
                   given ? "Enlarge that edge" : "Use more rods, or a box.shape nearer to a cube");
}

}  // namespace jostle
