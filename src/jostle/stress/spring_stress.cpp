#include "jostle/stress/spring_stress.hpp"

#include "jostle/parallel/sum_over_ranks.hpp"
#include "jostle/stress/collision_stress.hpp"

namespace jostle {

Mat3 sum_of_spring_stresses(std::span<const Spring> springs, std::span<const SpringPull> pulls, const Rods& rods,
                            std::span<const Vec3> centre, std::span<const Vec3> axis, const Ranks& ranks,
                            std::size_t own) {
    return sum_over_ranks<Mat3>(ranks, springs.size(), [&](std::size_t l) {
        const auto& [row_1, row_2, shift, direction, force] = pulls[l];
        if (row_1 >= own) return Mat3{};
        const Vec3 arm_1 = springs[l].s_1 * axis[row_1], arm_2 = springs[l].s_2 * axis[row_2];
        const double distance = dot(direction, pulls[l].separation(springs[l], centre, axis));
        const auto geometric = [&](std::uint32_t row, const Vec3& torque) {
            return geometric_stress_of_rod(axis[row], rods.length[row], rods.diameter[row], torque);
        };
        return outer(arm_1 + distance * direction - arm_2, force) + geometric(row_2, cross(arm_2, force)) +
               geometric(row_1, -cross(arm_1, force));
    });
}

}  // namespace jostle
