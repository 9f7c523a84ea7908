#include "jostle/stress/body_moments.hpp"

#include <fmt/format.h>

#include "jostle/error/refuse.hpp"
#include "jostle/math/symmetric_eigen.hpp"

namespace jostle {

namespace {

std::string words_of(const Mat3& a) {
    return fmt::format("{}", fmt::join(a.m, " "));
}

void require_mass(const char* key, std::size_t k, double mass) {
    if (!(std::isfinite(mass) && mass >= 0.0))
        refuse(fmt::format("{}[{}]", key, k), fmt::format("{}", mass), "no body has such a mass", "finite, >= 0");
}

}  // namespace

RigidBody rigid_body(const BodyMoments& body) {
    return {body.centre, body.second_moment};
}

BodyMoments with_density(BodyMoments body, double density) {
    if (!(std::isfinite(density) && density >= 0.0))
        refuse("density", fmt::format("{}", density), "no body has such a density", "finite, >= 0");
    body.mass *= density;
    body.second_moment *= density;
    return body;
}

BodyMoments moved(BodyMoments body, const Vec3& displacement) {
    body.centre += displacement;
    return body;
}

BodyMoments rotated(const BodyMoments& body, const Mat3& rotation) {
    require_rotation(rotation);
    return {body.mass, rotation * body.centre, rotation * body.second_moment * transpose(rotation)};
}

BodyMoments combined(std::span<const BodyMoments> parts) {
    BodyMoments whole;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        require_mass("mass", k, parts[k].mass);
        if (!is_finite(parts[k].centre) || !is_finite(parts[k].second_moment))
            refuse(fmt::format("parts[{}]", k), "", "has a centre or a second moment that is not finite", "");
        whole.mass += parts[k].mass;
        whole.centre += parts[k].mass * parts[k].centre;
    }
    if (!(whole.mass > 0.0)) refuse("mass", fmt::format("{}", whole.mass), "the parts weigh nothing", "> 0 in all");
    whole.centre = whole.centre / whole.mass;
    for (const BodyMoments& part : parts) {
        const Vec3 arm = part.centre - whole.centre;
        whole.second_moment += part.second_moment + part.mass * outer(arm, arm);
    }
    return whole;
}

BodyMoments point_moments(std::span<const Vec3> points, std::span<const double> weights) {
    if (points.size() != weights.size())
        refuse("weights", fmt::format("{} numbers", weights.size()), "must have one a point",
               fmt::format("{} numbers", points.size()));
    BodyMoments body;
    for (std::size_t k = 0; k < points.size(); ++k) {
        require_mass("weights", k, weights[k]);
        if (!is_finite(points[k])) refuse(fmt::format("points[{}]", k), "", "is not finite", "");
        body.mass += weights[k];
        body.centre += weights[k] * points[k];
    }
    if (!(body.mass > 0.0)) refuse("weights", "", "the points weigh nothing", "one of them > 0");
    body.centre = body.centre / body.mass;
    for (std::size_t k = 0; k < points.size(); ++k)
        body.second_moment += weights[k] * outer(points[k] - body.centre, points[k] - body.centre);
    return body;
}

Mat3 second_moment_of_inertia(const Mat3& inertia) {
    if (!is_finite(inertia)) refuse("inertia", words_of(inertia), "must be finite", "");
    const double size = norm(inertia);
    if (norm(inertia - transpose(inertia)) > 1e-12 * size)
        refuse("inertia", words_of(inertia), "must be symmetric", "");
    const auto principal = symmetric_eigen(inertia).values;
    const std::string value = words_of(inertia);
    if (!(principal[0] > 1e-14 * size))
        refuse(
            "inertia", value,
            fmt::format("has the principal moments {:.6g}, {:.6g}, {:.6g}", principal[0], principal[1], principal[2]),
            "positive definite");
    if (principal[2] > principal[0] + principal[1] + 1e-12 * size)
        refuse("inertia", value,
               fmt::format("has a principal moment, {:.6g}, larger than the sum of the other two, {:.6g} and {:.6g}",
                           principal[2], principal[0], principal[1]),
               "moments about the centre of mass that a body can have");
    return 0.5 * trace(inertia) * identity() - inertia;
}

void require_rotation(const Mat3& rotation) {
    const auto row = [&](int i) { return Vec3{rotation(i, 0), rotation(i, 1), rotation(i, 2)}; };
    if (!(norm(rotation * transpose(rotation) - identity()) <= 1e-6))
        refuse("orientation", words_of(rotation), "its rows are not unit vectors at right angles",
               "a rotation matrix, R R^T = I to 1e-6");
    if (dot(cross(row(0), row(1)), row(2)) < 0.0)
        refuse("orientation", words_of(rotation), "is a reflection", "a rotation matrix, det R = 1");
}

}  // namespace jostle
