#include "jostle/stress/spherocylinder_moments.hpp"

#include <fmt/format.h>

#include <numbers>

#include "jostle/error/input_error.hpp"

namespace jostle {

SpherocylinderMoments spherocylinder_moments(double length, double diameter) {
    if (!std::isfinite(length) || length < 0.0) {
        throw InputError({.key = "length",
                          .value = fmt::format("{}", length),
                          .problem = "a rod has no such length",
                          .allowed = "finite, >= 0",
                          .suggestion = "",
                          .place = {}});
    }
    if (!std::isfinite(diameter) || diameter <= 0.0) {
        throw InputError({.key = "diameter",
                          .value = fmt::format("{}", diameter),
                          .problem = "a rod has no such diameter",
                          .allowed = "finite, > 0",
                          .suggestion = "",
                          .place = {}});
    }
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
