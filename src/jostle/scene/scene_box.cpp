#include "jostle/scene/scene_box.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "jostle/parallel/parallel_for.hpp"
#include "jostle/rods/rods.hpp"
#include "jostle/scene/rod_size.hpp"

namespace jostle {

double rods_volume(const Scene& scene) {
    if (rods_are_alike(scene))
        return static_cast<double>(scene.rods.count) * rod_volume(scene.rods.length, scene.rods.diameter);
    const std::vector<RodSize> sizes = rod_sizes(scene);
    return parallel_sum<double>(sizes.size(),
                                [&](std::size_t id) { return rod_volume(sizes[id].length, sizes[id].diameter); });
}

Vec3 box_edges(const Scene& scene, double rods_volume) {
    if (scene.box.edges) return *scene.box.edges;
    const Vec3& shape = scene.box.shape;
    const double volume = rods_volume / (share_of_box(scene.walls.container) * scene.box.volume_fraction.value());
    return std::cbrt(volume / (shape.x * shape.y * shape.z)) * shape;
}

double volume_fraction(const Scene& scene, double rods_volume) {
    if (scene.box.volume_fraction) return *scene.box.volume_fraction;
    const Vec3& edges = scene.box.edges.value();
    return rods_volume / (share_of_box(scene.walls.container) * (edges.x * edges.y * edges.z));
}

Vec3 box_edges(const Scene& scene) {
    return box_edges(scene, rods_volume(scene));
}
double volume_fraction(const Scene& scene) {
    return volume_fraction(scene, rods_volume(scene));
}

double close_packing(double aspect_ratio) {
    return rod_volume(aspect_ratio, 1.0) * 2.0 / (std::numbers::sqrt2 + aspect_ratio * std::numbers::sqrt3);
}

double random_start_limit(double aspect_ratio) {
    return std::min(0.60 / (1.0 + aspect_ratio / 15.0), 4.5 / std::max(aspect_ratio, 1.0));
}

double isotropic_limit(double aspect_ratio) {
    constexpr double shortest = 3.5, onsager = 3.29, as_simulated = 1.05;
    if (aspect_ratio < shortest) return INFINITY;
    // g phi (1 - 3 phi/4) = 3.29 (1 - phi)^2
    const double g = aspect_ratio * aspect_ratio / (aspect_ratio + 2.0 / 3.0);
    const double a = onsager + 0.75 * g, b = 2.0 * onsager + g;
    return as_simulated * (b - std::sqrt(b * b - 4.0 * a * onsager)) / (2.0 * a);
}

}  // namespace jostle
