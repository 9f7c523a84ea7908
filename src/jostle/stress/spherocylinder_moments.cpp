#include "jostle/stress/spherocylinder_moments.hpp"

#include <fmt/format.h>

#include <numbers>

#include "jostle/error/refuse.hpp"
#include "jostle/stress/body_size.hpp"

namespace jostle {

SpherocylinderMoments spherocylinder_moments(double length, double diameter) {
    if (length != 0.0 && !is_size(length))
        refuse("length", fmt::format("{}", length), "a rod has no such length", "0, or 1e-30 to 1e30");
    if (!is_size(diameter))
        refuse("diameter", fmt::format("{}", diameter), "a rod has no such diameter", "1e-30 to 1e30");
    const double b = length / diameter;
    const double radius = 0.5 * diameter;
    const double unit = std::numbers::pi * radius * radius * radius * radius * radius;
    return {unit * (((10.0 * b + 20.0) * b + 15.0) * b + 4.0) / 15.0, unit * (15.0 * b + 8.0) / 30.0};
}

Mat3 second_moment(const SpherocylinderMoments& moments, const Vec3& axis) {
    const double difference = moments.second_moment_parallel - moments.second_moment_perpendicular;
    return moments.second_moment_perpendicular * identity() + difference * outer(axis, axis);
}

}  // namespace jostle
