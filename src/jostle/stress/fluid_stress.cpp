#include "jostle/stress/fluid_stress.hpp"

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

Mat3 stresslet(double size, const Vec3& axis) {
    return size * (outer(axis, axis) - (1.0 / 3.0) * identity());
}

}  // namespace

Mat3 sum_of_dipole_stresses(const Rods& rods, std::span<const double> dipole) {
    return parallel_sum<Mat3>(dipole.size(), [&](std::size_t i) { return stresslet(dipole[i], rods.axis[i]); });
}

Mat3 sum_of_thermal_stresses(const Rods& rods, double kT) {
    return parallel_sum<Mat3>(
        rods.size(), [&](std::size_t i) { return rods.length[i] > 0.0 ? stresslet(-3.0 * kT, rods.axis[i]) : Mat3{}; });
}

}  // namespace jostle
