#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "jostle/rods/body.hpp"
#include "jostle/rods/box.hpp"

namespace jostle {

/// A surface that rods stay on one side of: a plane, or the inside of a sphere or of a tube.
///
/// Along a straight line the distance from each of these is a concave function. Of a rod it is least at an end, so that
/// walls touch rods at their ends only.
struct Wall {
    enum class Shape { plane, sphere, tube };

    Shape shape = Shape::plane;
    std::uint32_t number = 0;  ///< 2 k and 2 k + 1: the lower and the upper face across direction k; 6: the container
    Vec3 point;                ///< on the plane; of a container its centre
    Vec3 direction;            ///< of a plane its normal, inwards; of a tube its axis; unit vectors
    double radius = 0.0;       ///< of a container

    /// Of a point from the surface; positive inside.
    double distance(const Vec3& x) const;
    /// Unit vector at a point: from the surface, the nearest way, to the inside.
    Vec3 inwards(const Vec3& x) const;
    std::uint32_t body() const { return fixed_body(number); }

    /// Gap between the surface and a sphere of this diameter around a point; negative: overlap.
    double gap(const Vec3& x, double diameter) const { return distance(x) - 0.5 * diameter; }
};

inline constexpr std::uint32_t container_number = 6, max_walls = 7;

constexpr bool is_wall(std::uint32_t body) {
    return is_fixed(body) && number_of_fixed(body) < max_walls;
}

/// The walls of a box, in the order of their numbers.
std::vector<Wall> walls_of(const Box& box);

/// The one of these that is this body. It must be among them.
const Wall& wall_of_body(std::span<const Wall> walls, std::uint32_t body);

/// Area of one wall of the box; in two dimensions its length.
double area_of(const Wall& wall, const Box& box);

/// "x lower", ..., "z upper", "sphere" or "tube".
const char* name_of(const Wall& wall);

/// Where walls may touch a rod: arms of its ends, along its axis; 0 alone of a sphere, or where walls turn no rod.
struct WallArms {
    double arm[2];
    int count;

    const double* begin() const { return arm; }
    const double* end() const { return arm + count; }
};
inline WallArms wall_arms(const Walls& walls, double length) {
    const double half = walls.turn_rods ? 0.5 * length : 0.0;
    return {{-half, half}, half > 0.0 ? 2 : 1};
}

/// How far a rod of this length and diameter reaches beyond the walls, at most; negative: it touches none. -infinity
/// without walls.
double overlap_with_walls(std::span<const Wall> walls, const Walls& of_box, const Vec3& centre, const Vec3& axis,
                          double length, double diameter);

/// The same of a row of the rods.
inline double overlap_with_walls(std::span<const Wall> walls, const Walls& of_box, const Rods& rods, std::size_t row) {
    return overlap_with_walls(walls, of_box, rods.centre[row], rods.axis[row], rods.length[row], rods.diameter[row]);
}

}  // namespace jostle
