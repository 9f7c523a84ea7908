#include "jostle/stress/orientation_stress.hpp"

#include "jostle/parallel/parallel_for.hpp"
#include "jostle/stress/spherocylinder_moments.hpp"

namespace jostle {

Mat3 orientation_stress_of_rod(const Vec3& axis, double length, double diameter, double kT, int dimensions) {
    if (kT == 0.0 || length == 0.0) return {};
    return (kT * moment_anisotropy(length / diameter)) * (identity(dimensions) - dimensions * outer(axis, axis));
}

Mat3 sum_of_orientation_stresses(const Rods& rods, double kT, int dimensions) {
    if (kT == 0.0) return {};
    return parallel_sum<Mat3>(rods.size(), [&](std::size_t i) {
        return orientation_stress_of_rod(rods.axis[i], rods.length[i], rods.diameter[i], kT, dimensions);
    });
}

}  // namespace jostle
