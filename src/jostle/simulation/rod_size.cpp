#include "jostle/simulation/rod_size.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "jostle/math/random.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

constexpr std::size_t part = 256;  ///< rods whose numbers are drawn together

bool too_far(const Normals& normal) {
    return std::fabs(normal[0]) > farthest_deviation || std::fabs(normal[1]) > farthest_deviation;
}

void draw(std::uint64_t seed, std::uint64_t draw, std::span<const std::uint64_t> ids, std::span<Normals> normals) {
    fill_normals({seed, draw, Stream::rod_size, 0}, ids, normals);
}

}  // namespace

double smallest_diameter(const Scene& scene, const Rods& rods) {
    const auto& diameter = rods.diameter;
    return diameter.empty() ? scene.rods.diameter : *std::min_element(diameter.begin(), diameter.end());
}

std::vector<RodSize> rod_sizes(const Scene& scene) {
    const RodSize mean = {scene.rods.length, scene.rods.diameter};
    const RodSize deviation = {scene.rods.length_deviation, scene.rods.diameter_deviation};
    std::vector<RodSize> sizes(scene.rods.count, mean);
    if (rods_are_alike(scene)) return sizes;
    parallel_for_blocks(sizes.size(), part, [&](std::size_t, std::size_t begin, std::size_t end) {
        std::array<std::uint64_t, part> ids;
        std::array<Normals, part> normals;
        const std::size_t count = end - begin;
        std::iota(ids.begin(), ids.end(), std::uint64_t{begin});
        draw(scene.seed, 0, std::span(ids).first(count), std::span(normals).first(count));
        for (std::size_t k = 0; k < count; ++k) {
            for (std::uint64_t again = 1; too_far(normals[k]); ++again)
                draw(scene.seed, again, {&ids[k], 1}, {&normals[k], 1});
            sizes[begin + k] = {mean.length + deviation.length * normals[k][0],
                                mean.diameter + deviation.diameter * normals[k][1]};
        }
    });
    return sizes;
}

}  // namespace jostle
