#include "jostle/rods/wall.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace jostle {

namespace {

/// From the middle of a container, across the axis of a tube.
Vec3 from_middle(const Wall& wall, const Vec3& x) {
    const Vec3 d = x - wall.point;
    return wall.shape == Wall::Shape::tube ? d - dot(d, wall.direction) * wall.direction : d;
}

Vec3 unit(int direction) {
    Vec3 vector;
    vector[direction] = 1.0;
    return vector;
}

Wall container_of(const Box& box) {
    const bool tube = box.walls().container == Container::tube;
    const int axis = box.walls().axis;
    const Vec3 edges = box.edges();
    return {tube ? Wall::Shape::tube : Wall::Shape::sphere, container_number, 0.5 * edges, tube ? unit(axis) : Vec3{},
            0.5 * edges[(axis + 1) % 3]};
}

}  // namespace

double Wall::distance(const Vec3& x) const {
    return shape == Shape::plane ? dot(x - point, direction) : radius - norm(from_middle(*this, x));
}

Vec3 Wall::inwards(const Vec3& x) const {
    if (shape == Shape::plane) return direction;
    const Vec3 outwards = from_middle(*this, x);
    const double length = norm(outwards);
    if (length > 0.0) return -1.0 / length * outwards;
    return shape == Shape::tube ? any_perpendicular(direction) : unit(0);
}

std::vector<Wall> walls_of(const Box& box) {
    std::vector<Wall> walls;
    for (int k = 0; k < 3; ++k) {
        if (!box.walls().faces[static_cast<std::size_t>(k)]) continue;
        const auto lower = static_cast<std::uint32_t>(2 * k);
        walls.push_back({Wall::Shape::plane, lower, {}, unit(k)});
        walls.push_back({Wall::Shape::plane, lower + 1, box.edges()[k] * unit(k), -unit(k)});
    }
    if (box.walls().container != Container::none) walls.push_back(container_of(box));
    return walls;
}

const Wall& wall_of_body(std::span<const Wall> walls, std::uint32_t body) {
    return *std::find_if(walls.begin(), walls.end(), [&](const Wall& wall) { return wall.body() == body; });
}

double area_of(const Wall& wall, const Box& box) {
    const Vec3& edges = box.edges();
    const double r = wall.radius;
    if (wall.shape == Wall::Shape::sphere) return 4.0 * std::numbers::pi * r * r;
    if (wall.shape == Wall::Shape::tube) {
        const double around = 2.0 * std::numbers::pi * r;
        return box.dimensions() == 2 ? around : around * edges[box.walls().axis];
    }
    const int k = static_cast<int>(wall.number) / 2;
    if (box.dimensions() == 2) return edges[1 - k];
    const bool cap = box.walls().container == Container::tube;  // of a tube
    return cap ? 0.25 * std::numbers::pi * edges[(k + 1) % 3] * edges[(k + 1) % 3]
               : edges[(k + 1) % 3] * edges[(k + 2) % 3];
}

const char* name_of(const Wall& wall) {
    constexpr const char* faces[] = {"x lower", "x upper", "y lower", "y upper", "z lower", "z upper"};
    if (wall.shape == Wall::Shape::plane) return faces[wall.number];
    return wall.shape == Wall::Shape::sphere ? "sphere" : "tube";
}

double overlap_with_walls(std::span<const Wall> walls, const Walls& of_box, const Vec3& centre, const Vec3& axis,
                          double length, double diameter) {
    double overlap = -INFINITY;
    for (const Wall& wall : walls)
        for (const double arm : wall_arms(of_box, length))
            overlap = std::max(overlap, 0.5 * diameter - wall.distance(centre + arm * axis));
    return overlap;
}

}  // namespace jostle
