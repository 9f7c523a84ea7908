#pragma once

#include <algorithm>
#include <map>
#include <vector>

#include "jostle/stress/mesh_moments.hpp"

// Closed triangle meshes for the tests.

namespace jostle::test {

struct Mesh {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
};

/// Corners at unit distance along the axes.
inline Mesh octahedron() {
    return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
            {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

/// The cuboid between two corners.
inline Mesh cuboid(const Vec3& low, const Vec3& high) {
    Mesh mesh;
    for (int k = 0; k < 8; ++k)
        mesh.vertices.push_back({k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z});
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

/// The corner of the unit cube at the origin, cut off by the plane x + y + z = 1.
inline Mesh corner_tetrahedron() {
    return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

/// The unit sphere by an octahedron whose triangles are cut into four, `levels` times, with corners on the sphere.
inline Mesh sphere_mesh(int levels) {
    Mesh mesh = octahedron();
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [place, is_new] =
                middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.vertices.size()));
            if (is_new) mesh.vertices.push_back(normalised(mesh.vertices[a] + mesh.vertices[b]));
            return place->second;
        };
        std::vector<Triangle> finer;
        for (const auto& [a, b, c] : mesh.triangles) {
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        mesh.triangles = finer;
    }
    return mesh;
}

}  // namespace jostle::test
