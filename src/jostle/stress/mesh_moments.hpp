#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "jostle/stress/body_moments.hpp"

namespace jostle {

/// The three corners of a triangle as rows of a list of vertices; anticlockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

/// Moments of what a closed triangle mesh encloses, with density 1: exact, a sum over the signed tetrahedra between a
/// point and the triangles (theory, eq. 1.13).
///
/// `vertices` (n x 3, length), `triangles` (m x 3). A surface of several pieces is allowed, and one inside another and
/// turned inside out is a hole. Surfaces that cut through themselves are not found out. Throws InputError if a number
/// is not finite, a triangle names a vertex that is not there or one twice, the mesh is open or its triangles are not
/// all turned the same way, it is inside out, or it encloses nothing.
BodyMoments mesh_moments(std::span<const Vec3> vertices, std::span<const Triangle> triangles);

/// Moments of the convex polyhedron around the points, with density 1. Points inside it do not matter.
///
/// `points` (n x 3, length), at least 4 that are not in a plane, else InputError. The hull is Qhull's (decision 0018).
BodyMoments convex_hull_moments(std::span<const Vec3> points);

}  // namespace jostle
