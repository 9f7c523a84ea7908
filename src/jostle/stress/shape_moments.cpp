#include "jostle/stress/shape_moments.hpp"

#include <fmt/format.h>

#include <numbers>
#include <vector>

#include "jostle/error/refuse.hpp"
#include "jostle/rods/rods.hpp"
#include "jostle/stress/body_size.hpp"
#include "jostle/stress/spherocylinder_moments.hpp"

namespace jostle {

namespace {

constexpr double pi = std::numbers::pi;

std::string words_of(const Vec3& a) {
    return fmt::format("{} {} {}", a.x, a.y, a.z);
}

void require_sizes(const char* key, const Vec3& sizes) {
    if (!(is_size(sizes.x) && is_size(sizes.y) && is_size(sizes.z)))
        refuse(key, words_of(sizes), "no body has such a size", "1e-30 to 1e30");
}

/// R diag(d) R^T.
Mat3 along_axes(const Mat3& orientation, const Vec3& diagonal) {
    require_rotation(orientation);
    Mat3 matrix;
    for (int k = 0; k < 3; ++k) {
        const Vec3 axis = {orientation(0, k), orientation(1, k), orientation(2, k)};
        matrix += diagonal[k] * outer(axis, axis);
    }
    return matrix;
}

Vec3 squares(const Vec3& a) {
    return {a.x * a.x, a.y * a.y, a.z * a.z};
}

}  // namespace

BodyMoments sphere_moments(double diameter) {
    if (!is_size(diameter))
        refuse("diameter", fmt::format("{}", diameter), "no sphere has such a diameter", "1e-30 to 1e30");
    const double mass = pi / 6.0 * diameter * diameter * diameter;
    return {mass, {}, (mass * diameter * diameter / 20.0) * identity()};
}

BodyMoments spherocylinder_moments(const Vec3& axis, double length, double diameter) {
    if (!(std::fabs(norm(axis) - 1.0) <= 1e-6)) refuse("axis", words_of(axis), "is no unit vector", "length 1 to 1e-6");
    const SpherocylinderMoments moments = spherocylinder_moments(length, diameter);
    return {rod_volume(length, diameter), {}, second_moment(moments, normalised(axis))};
}

BodyMoments box_moments(const Vec3& edges, const Mat3& orientation) {
    require_sizes("edges", edges);
    const double mass = edges.x * edges.y * edges.z;
    return {mass, {}, along_axes(orientation, mass / 12.0 * squares(edges))};
}

BodyMoments ellipsoid_moments(const Vec3& semi_axes, const Mat3& orientation) {
    require_sizes("semi_axes", semi_axes);
    const double mass = 4.0 * pi / 3.0 * semi_axes.x * semi_axes.y * semi_axes.z;
    return {mass, {}, along_axes(orientation, mass / 5.0 * squares(semi_axes))};
}

BodyMoments clump_moments(std::span<const Vec3> centres, std::span<const double> diameters) {
    if (centres.size() != diameters.size() || centres.empty())
        refuse("diameters", fmt::format("{} numbers", diameters.size()), "must have one a centre",
               fmt::format("{} numbers, at least 1", centres.size()));
    std::vector<BodyMoments> spheres;
    for (std::size_t k = 0; k < centres.size(); ++k) spheres.push_back(moved(sphere_moments(diameters[k]), centres[k]));
    return combined(spheres);
}

}  // namespace jostle
