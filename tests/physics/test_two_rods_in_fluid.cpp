// How mobile two rods are that are near each other, against rigid rods whose surfaces are covered with small spheres:
// what docs/guide/hydrodynamics.md says about rods near contact.

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "jostle/hydrodynamics/hydrodynamic_mobility.hpp"
#include "jostle/mobility/drag.hpp"

using namespace jostle;

namespace {

constexpr double pi = std::numbers::pi, length = 5.0;
constexpr int around = 10;  ///< small spheres around a rod
constexpr double spacing = pi / around, radius = 0.5 * spacing;

struct Surface {
    std::vector<Vec3> place;  ///< of the small spheres, from the rod's centre
};

/// Rings of small spheres at the distance `distance` from the segment of a rod along n.
Surface surface_of(const Vec3& n, double distance) {
    Surface surface;
    const Vec3 u = any_perpendicular(n), v = cross(n, u);
    const auto add_ring = [&](double along, double out, double turned) {
        const int count = std::max(1, static_cast<int>(std::lround(2.0 * pi * out / spacing)));
        for (int k = 0; k < count; ++k) {
            const double angle = 2.0 * pi * (k + turned) / count;
            surface.place.push_back(along * n + (out * std::cos(angle)) * u + (out * std::sin(angle)) * v);
        }
    };
    const int rings = static_cast<int>(std::lround(length / spacing));
    for (int k = 0; k <= rings; ++k) add_ring(length * (static_cast<double>(k) / rings - 0.5), distance, 0.5 * (k % 2));
    const int caps = static_cast<int>(std::lround(0.5 * pi * distance / spacing));
    for (int k = 1; k <= caps; ++k) {
        const double latitude = 0.5 * pi * k / caps;
        for (const double side : {-1.0, 1.0})
            add_ring(side * (0.5 * length + distance * std::sin(latitude)), distance * std::cos(latitude),
                     0.5 * (k % 2));
    }
    return surface;
}

/// Rotne and Prager 1969, Yamakawa 1970: of two spheres of `radius`, viscosity 1.
Eigen::Matrix3d rotne_prager(const Vec3& separation) {
    const Eigen::Vector3d r(separation.x, separation.y, separation.z);
    const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
    const double distance = r.norm(), a = radius;
    if (distance == 0.0) return one / (6.0 * pi * a);
    const Eigen::Matrix3d rr = r * r.transpose() / (distance * distance);
    if (distance < 2.0 * a)
        return ((1.0 - 9.0 * distance / (32.0 * a)) * one + 3.0 * distance / (32.0 * a) * rr) / (6.0 * pi * a);
    const double square = 2.0 * a * a / (distance * distance);
    return ((1.0 + square / 3.0) * one + (1.0 - square) * rr) / (8.0 * pi * distance);
}

/// Mobility of rigid rods: forces and torques of each, one after the other, to velocities.
Eigen::MatrixXd rigid_mobility(const std::vector<Surface>& rods, const std::vector<Vec3>& centres) {
    std::vector<Vec3> place;
    std::vector<std::size_t> owner;
    for (std::size_t i = 0; i < rods.size(); ++i)
        for (const Vec3& p : rods[i].place) {
            place.push_back(centres[i] + p);
            owner.push_back(i);
        }
    const auto count = static_cast<Eigen::Index>(place.size());
    Eigen::MatrixXd mobility(3 * count, 3 * count);
    Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(3 * count, 6 * static_cast<Eigen::Index>(rods.size()));
    for (Eigen::Index b = 0; b < count; ++b) {
        const auto at = static_cast<std::size_t>(b);
        for (Eigen::Index c = 0; c < count; ++c)
            mobility.block<3, 3>(3 * b, 3 * c) = rotne_prager(place[at] - place[static_cast<std::size_t>(c)]);
        const Vec3 arm = place[at] - centres[owner[at]];
        const Eigen::Index rod = 6 * static_cast<Eigen::Index>(owner[at]);
        motion.block<3, 3>(3 * b, rod).setIdentity();
        motion.block<3, 3>(3 * b, rod + 3) << 0, arm.z, -arm.y, -arm.z, 0, arm.x, arm.y, -arm.x, 0;
    }
    const Eigen::MatrixXd friction = motion.transpose() * mobility.llt().solve(motion);
    return friction.inverse();
}

/// The distance at which a rod of small spheres moves across its axis as a spherocylinder does.
double fitting_distance() {
    const double wanted = capsule_drag(length, 1.0, 1.0).perpendicular;
    double distance = 0.5 - 0.3 * radius;
    for (int round = 0; round < 4; ++round) {
        const auto found = [&](double d) { return rigid_mobility({surface_of({0, 0, 1}, d)}, {{0, 0, 0}})(0, 0); };
        const double now = found(distance), slope = (found(distance + 1e-3) - now) / 1e-3;
        distance += (wanted - now) / slope;
    }
    return distance;
}

struct Geometry {
    std::string name;
    Vec3 axis, separation;  ///< of the second rod; the first lies along z
    double arm_i, arm_j;
    double least, largest;  ///< of the model's A_ll over that of rigid rods
};

}  // namespace

TEST_CASE("relative mobility of two rods L/D = 5 over that of rigid rods: right from 3 D on, too large near contact") {
    const double distance = fitting_distance();
    const HydrodynamicMobility model(1.0);
    const Box box{{100, 100, 100}, {false, false, false}};
    const Vec3 x{1, 0, 0}, z{0, 0, 1};
    for (const Geometry& geometry : {Geometry{"side by side, axes 6 D apart", z, {6, 0, 0}, 0, 0, 1.0, 1.02},
                                     Geometry{"side by side, axes 3 D apart", z, {3, 0, 0}, 0, 0, 1.04, 1.09},
                                     Geometry{"side by side, axes 1.5 D apart", z, {1.5, 0, 0}, 0, 0, 1.4, 1.7},
                                     Geometry{"side by side, axes 1.05 D apart", z, {1.05, 0, 0}, 0, 0, 3.5, 6.0},
                                     Geometry{"crossed, axes 2 D apart", {0, 1, 0}, {2, 0, 0}, 0, 0, 1.15, 1.35},
                                     Geometry{"crossed, axes 1.05 D apart", {0, 1, 0}, {1.05, 0, 0}, 0, 0, 2.5, 3.6},
                                     Geometry{"end to side, gap 2.5 D", x, {6, 0, 0}, 0, -2.5, 1.0, 1.04},
                                     Geometry{"end to side, gap 0.05 D", x, {3.55, 0, 0}, 0, -2.5, 1.9, 2.8}}) {
        const Vec3 centre = geometry.separation;
        const Eigen::MatrixXd rigid =
            rigid_mobility({surface_of(z, distance), surface_of(geometry.axis, distance)}, {{0, 0, 0}, centre});
        Eigen::VectorXd push = Eigen::VectorXd::Zero(12);  // equal and opposite, along x
        push(0) = -1.0;
        push(6) = 1.0;
        const Vec3 torque = cross(geometry.arm_j * geometry.axis, x);
        push.segment<3>(9) << torque.x, torque.y, torque.z;
        const double expected = push.dot(rigid * push);

        Rods rods;
        rods.push_back(0, {0, 0, 0}, z, length, 1.0);
        rods.push_back(1, centre, geometry.axis, length, 1.0);
        const double apart = centre.x + geometry.arm_j * geometry.axis.x;
        const PairOfPoints points{0, 1, geometry.arm_i, geometry.arm_j, x, apart};
        const auto mobility = model.at(rods, box);
        const double found = mobility->relative_mobility(points);
        const double alone = mobility->MobilityOperator::relative_mobility(points);
        MESSAGE(geometry.name, ": with the fluid ", found / expected, ", without ", alone / expected);
        CHECK(found > geometry.least * expected);
        CHECK(found < geometry.largest * expected);
        CHECK(found < alone);
    }
}
