#pragma once

#include <array>

#include "jostle/rods/rods.hpp"

namespace jostle {

/// A rectangular box with one corner at the origin, periodic or open along each direction.
///
/// Open means without walls: rods may leave; the edge then only defines the volume that phi and n refer to.
struct Box {
    Vec3 edges{1, 1, 1};
    std::array<bool, 3> periodic{true, true, true};

    double volume() const { return edges.x * edges.y * edges.z; }

    bool is_periodic() const { return periodic[0] && periodic[1] && periodic[2]; }

    /// The vector by which a copy is displaced: image * edges, element by element.
    Vec3 displacement(const Image& image) const { return {image[0] * edges.x, image[1] * edges.y, image[2] * edges.z}; }

    /// Moves `centre` into [0, edge) along periodic directions, and counts the edges crossed in `image`.
    void wrap(Vec3& centre, Image& image) const;
};

}  // namespace jostle
