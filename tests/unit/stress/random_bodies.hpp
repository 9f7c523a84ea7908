#pragma once

#include <random>

#include "jostle/math/rotation.hpp"
#include "jostle/stress/mesh_moments.hpp"
#include "jostle/stress/shape_moments.hpp"
#include "meshes.hpp"

// Random rigid bodies and vectors for the tests of the pair stress.

namespace jostle::test {

inline Vec3 random_vector(std::mt19937_64& generator) {
    std::normal_distribution<double> normal;
    const double x = normal(generator), y = normal(generator), z = normal(generator);
    return {x, y, z};
}

inline Vec3 random_direction(std::mt19937_64& generator) {
    return normalised(random_vector(generator));
}

/// The second moment of eight masses at random places, one of them as far off as to make the body slender now and then.
inline Mat3 random_second_moment(std::mt19937_64& generator) {
    std::uniform_real_distribution<double> mass(0.1, 1.0);
    Mat3 moment;
    for (int k = 0; k < 8; ++k) {
        const Vec3 x = (k == 0 ? 3.0 : 1.0) * random_vector(generator);
        moment += mass(generator) * outer(x, x);
    }
    return moment;
}

inline Mat3 random_rotation(std::mt19937_64& generator) {
    std::normal_distribution<double> normal;
    const double w = normal(generator), x = normal(generator), y = normal(generator), z = normal(generator);
    return rotation_of_quaternion(w, x, y, z);
}

inline Vec3 random_sizes(std::mt19937_64& generator) {
    std::uniform_real_distribution<double> size(0.3, 2.0);
    const double a = size(generator), b = size(generator), c = size(generator);
    return {a, b, c};
}

/// An octahedron whose six corners are moved along their axes, then turned: closed, and mostly not convex.
inline Mesh random_octahedron(std::mt19937_64& generator) {
    Mesh mesh = octahedron();
    const Mat3 rotation = random_rotation(generator);
    for (Vec3& vertex : mesh.vertices) vertex = rotation * (random_sizes(generator).x * vertex);
    return mesh;
}

/// A rod with a heavier end: a spherocylinder and a dense sphere at the end of its axis.
inline BodyMoments rod_with_heavy_end(double length, double diameter, double excess_density) {
    const BodyMoments rod = spherocylinder_moments({0, 0, 1}, length, diameter);
    const BodyMoments end = moved(with_density(sphere_moments(diameter), excess_density), {0, 0, 0.5 * length});
    return combined(std::array{rod, end});
}

/// Every kind of body, of random sizes, turned.
inline BodyMoments random_moments(std::mt19937_64& generator) {
    const Vec3 sizes = random_sizes(generator);
    const Mat3 rotation = random_rotation(generator);
    switch (std::uniform_int_distribution<int>(0, 6)(generator)) {
        case 0:
            return sphere_moments(sizes.x);
        case 1:
            return spherocylinder_moments(random_direction(generator), 3.0 * sizes.x, sizes.y);
        case 2:
            return box_moments(sizes, rotation);
        case 3:
            return ellipsoid_moments(sizes, rotation);
        case 4: {
            const Mesh mesh = random_octahedron(generator);
            return mesh_moments(mesh.vertices, mesh.triangles);
        }
        case 5:
            return rotated(rod_with_heavy_end(3.0 * sizes.x, sizes.y, 5.0 * sizes.z), rotation);
        default: {
            const Vec3 second = random_vector(generator);
            return clump_moments(std::array{Vec3{}, second}, std::array{sizes.x, sizes.y});
        }
    }
}

/// Eight masses, or any other body, at a random place.
inline RigidBody random_body(std::mt19937_64& generator) {
    const Vec3 centre = 3.0 * random_vector(generator);
    if (std::bernoulli_distribution(0.3)(generator)) return {centre, random_second_moment(generator)};
    return rigid_body(moved(random_moments(generator), centre));
}

/// eps_kij a_ij: the axial vector of the antisymmetric part.
inline Vec3 axial(const Mat3& a) {
    return {a(1, 2) - a(2, 1), a(2, 0) - a(0, 2), a(0, 1) - a(1, 0)};
}

}  // namespace jostle::test
