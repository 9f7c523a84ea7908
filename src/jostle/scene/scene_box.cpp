#include "jostle/scene/scene_box.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "jostle/parallel/parallel_for.hpp"
#include "jostle/rods/rods.hpp"
#include "jostle/scene/rod_size.hpp"

namespace jostle {

namespace {

Vec3 in_box_of(const Scene& scene, const Vec3& vector) {
    return dimensions_of(scene) == 2 ? Vec3{vector.x, vector.y, 0.0} : vector;
}

}  // namespace

const char* fraction_key(const Scene& scene) {
    return dimensions_of(scene) == 2 ? "box.area_fraction" : "box.volume_fraction";
}
const char* fraction_words(const Scene& scene) {
    return dimensions_of(scene) == 2 ? "area fraction" : "volume fraction";
}
const std::optional<double>& given_fraction(const Scene& scene) {
    return dimensions_of(scene) == 2 ? scene.box.area_fraction : scene.box.volume_fraction;
}

std::array<bool, 3> box_periodic(const Scene& scene) {
    const auto [x, y, z] = scene.box.periodic;
    return {x, y, z && dimensions_of(scene) == 3};
}

double rods_volume(const Scene& scene) {
    const int dimensions = dimensions_of(scene);
    if (rods_are_alike(scene))
        return static_cast<double>(scene.rods.count) * rod_volume(scene.rods.length, scene.rods.diameter, dimensions);
    const std::vector<RodSize> sizes = rod_sizes(scene);
    return parallel_sum<double>(
        sizes.size(), [&](std::size_t id) { return rod_volume(sizes[id].length, sizes[id].diameter, dimensions); });
}

Vec3 box_edges(const Scene& scene, double rods_volume) {
    if (scene.box.edges) return in_box_of(scene, *scene.box.edges);
    const Vec3 shape = in_box_of(scene, scene.box.shape);
    const double volume = rods_volume / (share_of_box(scene.walls.container) * given_fraction(scene).value());
    if (dimensions_of(scene) == 2) return std::sqrt(volume / volume_of(shape)) * shape;
    return std::cbrt(volume / (shape.x * shape.y * shape.z)) * shape;
}

double volume_fraction(const Scene& scene, double rods_volume) {
    if (given_fraction(scene)) return *given_fraction(scene);
    const Vec3 edges = in_box_of(scene, scene.box.edges.value());
    return rods_volume / (share_of_box(scene.walls.container) * volume_of(edges));
}

Vec3 box_edges(const Scene& scene) {
    return box_edges(scene, rods_volume(scene));
}
double volume_fraction(const Scene& scene) {
    return volume_fraction(scene, rods_volume(scene));
}

double close_packing(double aspect_ratio, int dimensions) {
    if (dimensions == 2) return rod_volume(aspect_ratio, 1.0, 2) / (aspect_ratio + 0.5 * std::numbers::sqrt3);
    return rod_volume(aspect_ratio, 1.0) * 2.0 / (std::numbers::sqrt2 + aspect_ratio * std::numbers::sqrt3);
}

double random_start_limit(double aspect_ratio, int dimensions) {
    if (dimensions == 2) return 0.70 / (1.0 + aspect_ratio / 40.0);
    return std::min(0.60 / (1.0 + aspect_ratio / 15.0), 4.5 / std::max(aspect_ratio, 1.0));
}

double isotropic_limit(double aspect_ratio, int dimensions) {
    constexpr double shortest_in_plane = 7.0, of_needles = 7.0;
    if (dimensions == 2)
        return aspect_ratio < shortest_in_plane
                   ? INFINITY
                   : of_needles * rod_volume(aspect_ratio, 1.0, 2) / (aspect_ratio * aspect_ratio);
    constexpr double shortest = 3.5, onsager = 3.29, as_simulated = 1.05;
    if (aspect_ratio < shortest) return INFINITY;
    // g phi (1 - 3 phi/4) = 3.29 (1 - phi)^2
    const double g = aspect_ratio * aspect_ratio / (aspect_ratio + 2.0 / 3.0);
    const double a = onsager + 0.75 * g, b = 2.0 * onsager + g;
    return as_simulated * (b - std::sqrt(b * b - 4.0 * a * onsager)) / (2.0 * a);
}

}  // namespace jostle
