#include "jostle/rods/spring.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "jostle/error/input_error.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

constexpr std::uint32_t no_row = std::numeric_limits<std::uint32_t>::max();

/// Row of every id that a spring may name (largest id + 1).
std::vector<std::uint32_t> rows_by_id(const Rods& rods) {
    std::uint64_t ids = 0;
    for (const std::uint64_t id : rods.id) ids = std::max(ids, id + 1);
    std::vector<std::uint32_t> rows(ids, no_row);
    parallel_for(rods.size(), [&](std::size_t i) { rows[rods.id[i]] = static_cast<std::uint32_t>(i); });
    return rows;
}

void require_rods(std::span<const Spring> springs, const std::vector<std::uint32_t>& rows) {
    for (const Spring& spring : springs)
        for (const std::uint64_t id : {spring.rod_1, spring.rod_2})
            if (id >= rows.size() || rows[id] == no_row)
                throw InputError(
                    {.key = "springs", .value = std::to_string(id), .problem = "there is no rod of this id"});
}

}  // namespace

std::vector<SpringPull> spring_pulls(std::span<const Spring> springs, const Rods& rods, const Box& box) {
    const std::vector<std::uint32_t> rows = rows_by_id(rods);
    require_rods(springs, rows);
    std::vector<SpringPull> pulls(springs.size());
    parallel_for(springs.size(), [&](std::size_t l) {
        const Spring& spring = springs[l];
        SpringPull& pull = pulls[l];
        pull.row_1 = rows[spring.rod_1];
        pull.row_2 = rows[spring.rod_2];
        Image image = spring.image;
        for (std::size_t k = 0; k < 3; ++k) image[k] += rods.image[pull.row_2][k] - rods.image[pull.row_1][k];
        pull.shift = box.displacement(image);
        const Vec3 separation = pull.separation(spring, rods.centre, rods.axis);
        const double distance = norm(separation);
        if (distance == 0.0) return;
        pull.direction = (1.0 / distance) * separation;
        pull.force = -spring.stiffness * (distance - spring.rest_length) * pull.direction;
    });
    return pulls;
}

Forces spring_forces(std::span<const Spring> springs, std::span<const SpringPull> pulls, const Rods& rods) {
    Forces forces(rods.size());
    for (std::size_t l = 0; l < springs.size(); ++l) {  // in order: the same bits for any number of threads
        const auto& [row_1, row_2, shift, direction, force] = pulls[l];
        forces.force[row_1] -= force;
        forces.force[row_2] += force;
        forces.torque[row_1] -= springs[l].s_1 * cross(rods.axis[row_1], force);
        forces.torque[row_2] += springs[l].s_2 * cross(rods.axis[row_2], force);
    }
    return forces;
}

void hold_nearest_images(std::vector<Spring>& springs, const Rods& rods, const Box& box) {
    for (Spring& spring : springs) spring.image = {};
    const std::vector<SpringPull> pulls = spring_pulls(springs, rods, box);
    for (std::size_t l = 0; l < springs.size(); ++l) {
        Vec3 separation = pulls[l].separation(springs[l], rods.centre, rods.axis);
        for (const int k : {1, 0, 2}) {  // across y first, which may move a copy along x
            if (!box.periodic()[static_cast<std::size_t>(k)]) continue;
            const auto image = -static_cast<std::int32_t>(std::lround(separation[k] / box.edges()[k]));
            springs[l].image[static_cast<std::size_t>(k)] = image;
            if (k == 1) separation.x += image * box.offset();
        }
    }
}

}  // namespace jostle
