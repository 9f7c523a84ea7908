#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "jostle/rods/rods.hpp"
#include "jostle/rods/walls.hpp"

namespace jostle {

/// Of a box with these edges: 2 if it is flat.
constexpr int dimensions_of(const Vec3& edges) {
    return edges.z == 0.0 ? 2 : 3;
}

/// Their product. In two dimensions the area.
constexpr double volume_of(const Vec3& edges) {
    return dimensions_of(edges) == 2 ? edges.x * edges.y : edges.x * edges.y * edges.z;
}

/// A rectangular box with one corner at the origin, periodic, open or closed by walls along each direction. A box of
/// another size is another box.
///
/// Where the rods are sheared, the copies above along y are displaced along x (Lees and Edwards): one copy above by
/// `offset`, two by twice as much.
///
/// Open means without walls: rods may leave; the edge then only defines the volume that phi and n refer to.
///
/// A box whose edge along z is 0 is flat: it has two dimensions, x and y. All centres and axes are in the plane z = 0,
/// where nothing moves them out of it, and what is a volume elsewhere is an area.
class Box {
public:
    constexpr Box() = default;
    /// It is not to be periodic across walls, nor along an edge of 0.
    constexpr Box(const Vec3& edges, const std::array<bool, 3>& periodic = {true, true, true}, const Walls& walls = {})
        : edges_(edges), periodic_(periodic), walls_(walls) {}

    const Vec3& edges() const { return edges_; }
    const std::array<bool, 3>& periodic() const { return periodic_; }
    const Walls& walls() const { return walls_; }
    /// Rods that no force moves (theory, section 6), with ids from 0; null: none.
    const std::shared_ptr<const Rods>& fixed_rods() const { return fixed_rods_; }
    /// At most half the edge along x, to either side: beyond, the next copy is nearer.
    double offset() const { return offset_; }
    /// Along every direction that it has.
    bool is_periodic() const { return periodic_[0] && periodic_[1] && (periodic_[2] || dimensions() == 2); }
    int dimensions() const { return dimensions_of(edges_); }

    /// Between the walls. In two dimensions the area.
    double volume() const { return share_of_box(walls_.container) * volume_of(edges_); }
    double longest_edge() const { return std::max({edges_.x, edges_.y, edges_.z}); }

    /// Whether nothing but rods that move pushes rods in it.
    bool holds_rods_alone() const { return !walls_.any() && !fixed_rods_; }

    /// The same box with other edges, or with fixed rods.
    Box with_edges(const Vec3& edges) const {
        Box other = *this;
        other.edges_ = edges;
        return other;
    }
    Box with_fixed_rods(std::shared_ptr<const Rods> fixed) const {
        Box other = *this;
        other.fixed_rods_ = std::move(fixed);
        return other;
    }

    /// The point that lies at these parts of the edges, 0 to 1 within the box.
    Vec3 point_at(const Vec3& parts) const { return {parts.x * edges_.x, parts.y * edges_.y, parts.z * edges_.z}; }

    /// The same box, the copies above displaced so; it has to be periodic along x and y. `offset`: any length, of which
    /// whole edges are left out.
    Box sheared(double offset) const;

    /// The vector by which a copy is displaced: image * edges, element by element, and the offset of copies above.
    Vec3 displacement(const Image& image) const {
        return {image[0] * edges_.x + image[1] * offset_, image[1] * edges_.y, image[2] * edges_.z};
    }

    /// Moves `centre` into [0, edge) along periodic directions, and counts the edges crossed in `image`:
    /// centre + displacement(image) stays.
    void wrap(Vec3& centre, Image& image) const;

private:
    Vec3 edges_{1, 1, 1};
    std::array<bool, 3> periodic_{true, true, true};
    Walls walls_{};
    std::shared_ptr<const Rods> fixed_rods_{};
    double offset_ = 0.0;
};

}  // namespace jostle
