#include <doctest/doctest.h>

#include "jostle/stress/fluid_stress.hpp"

using namespace jostle;

namespace {

double difference(const Mat3& a, const Mat3& b) {
    double largest = 0.0;
    for (std::size_t k = 0; k < 9; ++k) largest = std::max(largest, std::fabs(a.m[k] - b.m[k]));
    return largest;
}

}  // namespace

// Pushers press along their axis: the fluid is pushed away at both ends.
TEST_CASE("a swimmer along x: p (xx - I/3); thermal turning: -3 kT (xx - I/3), of rods and not of spheres") {
    Rods rods;
    rods.push_back(0, {1, 1, 1}, {1, 0, 0}, 5.0, 1.0);
    const Mat3 stresslet = outer(Vec3{1, 0, 0}, Vec3{1, 0, 0}) - (1.0 / 3.0) * identity();
    const std::vector<double> pusher = {2.0}, both = {2.0, -1.0};
    CHECK(difference(sum_of_dipole_stresses(rods, pusher), 2.0 * stresslet) < 1e-15);
    CHECK(difference(sum_of_thermal_stresses(rods, 0.5), -1.5 * stresslet) < 1e-15);
    rods.push_back(1, {2, 2, 2}, {0, 1, 0}, 0.0, 1.0);  // a puller along y, a sphere
    const Mat3 along_y = outer(Vec3{0, 1, 0}, Vec3{0, 1, 0}) - (1.0 / 3.0) * identity();
    CHECK(difference(sum_of_dipole_stresses(rods, both), 2.0 * stresslet - along_y) < 1e-15);
    CHECK(difference(sum_of_thermal_stresses(rods, 0.5), -1.5 * stresslet) < 1e-15);
    CHECK(sum_of_dipole_stresses(rods, {}).m == Mat3{}.m);  // none stirs
}
