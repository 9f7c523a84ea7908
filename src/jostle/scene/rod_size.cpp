#include "jostle/scene/rod_size.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/sysinfo.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "jostle/error/refuse.hpp"
#include "jostle/math/random.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

constexpr std::size_t drawn_together = 256;  ///< rods whose numbers are drawn together
constexpr double bytes_per_rod = 480.0;      ///< of a run where they are dilute, its least (docs/performance.md)

/// Of the machine, or what this process is allowed of it.
double bytes_of_memory() {
    struct sysinfo machine {};
    rlimit limit{};
    double bytes = std::numeric_limits<double>::infinity();
    if (sysinfo(&machine) == 0) bytes = static_cast<double>(machine.totalram) * machine.mem_unit;
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        bytes = std::min(bytes, static_cast<double>(limit.rlim_cur));
    return bytes;
}

/// Rods that are not alike are drawn one by one, in vain where no run could hold them.
void require_room(std::uint64_t count) {
    const double needed = bytes_per_rod * static_cast<double>(count), there = bytes_of_memory();
    if (needed <= there) return;
    refuse("rods.count", fmt::format("{}", count),
           fmt::format("a run of so many rods needs {:.3g} GB of memory at least, "
                       "and this machine gives {:.3g} GB",
                       needed / 1e9, there / 1e9),
           fmt::format("here at most {:.0f}", std::floor(there / bytes_per_rod)));
}

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

Rods representative_rods(const Scene& scene) {
    Rods rods;
    if (rods_are_alike(scene) && scene.motion.self_propulsion_deviation == 0.0)
        rods.push_back(0, {}, {1, 0, 0}, scene.rods.length, scene.rods.diameter);
    else
        for (const RodSize& size : rod_sizes(scene))
            rods.push_back(rods.size(), {}, {1, 0, 0}, size.length, size.diameter);
    return rods;
}

std::vector<RodSize> rod_sizes(const Scene& scene) {
    require_room(scene.rods.count);
    const RodSize mean = {scene.rods.length, scene.rods.diameter};
    const RodSize deviation = {scene.rods.length_deviation, scene.rods.diameter_deviation};
    std::vector<RodSize> sizes(scene.rods.count, mean);
    if (rods_are_alike(scene)) return sizes;
    parallel_for_blocks(sizes.size(), drawn_together, [&](std::size_t, std::size_t begin, std::size_t end) {
        std::array<std::uint64_t, drawn_together> ids;
        std::array<Normals, drawn_together> normals;
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
