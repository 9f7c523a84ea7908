#include "jostle/simulation/rod_size.hpp"

#include <cmath>

#include "jostle/math/random.hpp"

namespace jostle {

RodSize rod_size(const Scene& scene, std::uint64_t id) {
    const RodSize mean = {scene.rods.length, scene.rods.diameter};
    const RodSize deviation = {scene.rods.length_deviation, scene.rods.diameter_deviation};
    if (rods_are_alike(scene)) return mean;
    for (std::uint64_t draw = 0;; ++draw) {
        Normals normal;
        fill_normals({scene.seed, draw, Stream::rod_size, 0}, {&id, 1}, {&normal, 1});
        if (std::fabs(normal[0]) > farthest_deviation || std::fabs(normal[1]) > farthest_deviation) continue;
        return {mean.length + deviation.length * normal[0], mean.diameter + deviation.diameter * normal[1]};
    }
}

}  // namespace jostle
