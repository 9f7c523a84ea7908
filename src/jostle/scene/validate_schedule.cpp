#include "jostle/scene/validate_schedule.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "jostle/error/refuse.hpp"
#include "jostle/rods/rods.hpp"
#include "jostle/scene/number_text.hpp"
#include "jostle/scene/rod_size.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/scene/scene_keys.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/schedule.hpp"

namespace jostle {

namespace {

/// Whether a schedule of the box changes an edge, as far as the scene tells.
bool squeezes_edge(const Scene& scene, int k) {
    if (scene.schedule.edges.empty() || !scene.box.edges) return true;
    return std::any_of(scene.schedule.edges.begin(), scene.schedule.edges.end(),
                       [&](const RampPoint<Vec3>& point) { return point.value[k] != (*scene.box.edges)[k]; });
}

}  // namespace

void validate_schedule(const Scene& scene) {
    if (!squeezes_box(scene)) return;
    if (!scene.schedule.edges.empty() && !ramp_of_fraction(scene).empty())
        refuse("schedule.edges", "",
               fmt::format("is given beside schedule.{}", parts_of_key(fraction_key(scene)).second),
               "one of the two, not both", "Keep one of them; the other follows from it");
    const std::string key = key_of_box_ramp(scene);
    if (grows(scene))
        refuse(key, "", "changes the box, and with growth.rate cells change what fills it", "one of the two, not both",
               "Remove [growth], or the key");
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimensions_of(scene)); ++k)
        if (!scene.box.periodic[k] && !scene.walls.faces[k] && squeezes_edge(scene, static_cast<int>(k)))
            refuse(key, "",
                   fmt::format("changes edge {}, along which the box is open: nothing holds the rods", "xyz"[k]),
                   "edges along which the box is periodic, or ends at planes (walls.faces)",
                   "Keep that edge as box.edges has it, or make the box periodic along it");
}

void validate_packing_of_schedule(const Scene& scene) {
    if (!squeezes_box(scene)) return;
    const double volume = rods_volume(scene), aspect_ratio = scene.rods.length / scene.rods.diameter;
    const double densest = close_packing(aspect_ratio, dimensions_of(scene));
    const char* words = fraction_words(scene);
    for (const auto& [time, edges] : ramp_of_edges(scene, volume)) {
        const double fraction = volume / volume_of(edges);
        if (fraction <= densest * (1.0 + 1e-12)) continue;
        refuse(
            key_of_box_ramp(scene), "",
            fmt::format("cannot be packed at time {}: it makes the {} {}, and the densest packing of rods of L/D = {} "
                        "fills {}",
                        time, words, rounded(fraction), rounded(aspect_ratio), rounded(densest)),
            fmt::format("{} {} of at most {}", dimensions_of(scene) == 2 ? "an" : "a", words, rounded(densest)),
            "Compress less");
    }
}

}  // namespace jostle
