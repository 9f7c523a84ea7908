#include "jostle/contact/gap_drift.hpp"

#include <algorithm>
#include <cmath>

#include "jostle/contact/fixed_rod_grid.hpp"

namespace jostle {

namespace {

/// Arms within this part of a half length are at the end.
constexpr double at_end = 1.0 - 1e-9;
/// Axes nearer to parallel than this touch at ends, and the formula of two sides is left at this sine squared.
constexpr double least_squared_sine = 0.09;

}  // namespace

/// A rod as one side of a contact.
struct GapDrift::Side {
    MobileRod rod;
    double arm, half;

    bool is_end() const { return std::fabs(arm) >= at_end * half; }
    double mobility(const Vec3& direction) const { return point_mobility(rod, direction, arm); }
};

GapDrift::Side GapDrift::side_of_rod(std::uint32_t row, double arm) const {
    return {{axes_(row), own_[row]}, arm, 0.5 * rods_.length[row]};
}

GapDrift::Side GapDrift::side_of_fixed_rod(const Contact& contact, const Image& image) const {
    const PairGeometry pair = pair_with(*box_.fixed_rods(), copy_of(contact, image, box_), rods_, contact.j,
                                        rods_.centre[contact.j], axes_(contact.j));
    const double along = dot(pair.centre_separation + contact.arm_j * pair.axis_j, pair.axis_i);
    return {{pair.axis_i, RodMobility{0.0, 0.0, 0.0}}, std::clamp(along, -pair.half_i, pair.half_i), pair.half_i};
}

double GapDrift::operator()(const Contact& contact, const Image& image) const {
    if (contact.i == contact.j) return 0.0;  // its gap is an angle
    const int turns = box_.dimensions() - 1;
    const Side j = side_of_rod(contact.j, contact.arm_j);
    double drift = -turns * j.rod.mobility.rotational * contact.arm_j * dot(j.rod.axis, contact.normal);
    if (is_wall(contact.i)) return drift + at_wall(contact);
    const Side i = is_fixed(contact.i) ? side_of_fixed_rod(contact, image) : side_of_rod(contact.i, contact.arm_i);
    drift += turns * i.rod.mobility.rotational * i.arm * dot(i.rod.axis, contact.normal);
    return drift + between(i, j, contact.normal,
                           is_fixed(contact.i) ? 0.5 * (box_.fixed_rods()->diameter[number_of_fixed_rod(contact.i)] +
                                                        rods_.diameter[contact.j])
                                               : contact_radii(contact, rods_));
}

double GapDrift::between(const Side& i, const Side& j, const Vec3& normal, double distance) const {
    const auto along = [&](const Vec3& direction) { return i.mobility(direction) + j.mobility(direction); };
    const bool flat = box_.dimensions() == 2;
    if (i.is_end() && j.is_end()) {
        const Vec3 first = flat ? Vec3{-normal.y, normal.x, 0.0} : any_perpendicular(normal);
        return (along(first) + (flat ? 0.0 : along(cross(normal, first)))) / distance;
    }
    const double turning_i = i.is_end() ? 0.0 : i.rod.mobility.rotational;
    const double turning_j = j.is_end() ? 0.0 : j.rod.mobility.rotational;
    if (!i.is_end() && !j.is_end()) {
        const double cosine = dot(i.rod.axis, j.rod.axis);
        return flat ? 0.0 : -distance * (turning_i + turning_j) / std::max(1.0 - cosine * cosine, least_squared_sine);
    }
    const Vec3 across = cross(normal, i.is_end() ? j.rod.axis : i.rod.axis);
    const double length = norm(across);
    const double curved = flat || !(length > 0.0) ? 0.0 : along(across / length) / distance;
    return curved - distance * (turning_i + turning_j);
}

double GapDrift::at_wall(const Contact& contact) const {
    const Wall& wall = wall_of_body(walls_, contact.i);
    if (wall.shape == Wall::Shape::plane) return 0.0;
    const Side j = side_of_rod(contact.j, contact.arm_j);
    const double from_centre = wall.radius - 0.5 * rods_.diameter[contact.j];
    const Vec3 first = wall.shape == Wall::Shape::tube ? cross(contact.normal, wall.direction)
                       : box_.dimensions() == 2        ? Vec3{-contact.normal.y, contact.normal.x, 0.0}
                                                       : any_perpendicular(contact.normal);
    const bool two = wall.shape == Wall::Shape::sphere && box_.dimensions() == 3;
    return -(j.mobility(first) + (two ? j.mobility(cross(contact.normal, first)) : 0.0)) / from_centre;
}

}  // namespace jostle
