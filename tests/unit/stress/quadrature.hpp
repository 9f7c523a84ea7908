#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "jostle/math/mat3.hpp"
#include "meshes.hpp"

// Integrals over bodies that know nothing of closed forms; all are exact to rounding for polynomials of second degree.

namespace jostle::test {

inline constexpr std::array<double, 5> nodes = {-0.90617984593866399, -0.53846931010568309, 0.0, 0.53846931010568309,
                                                0.90617984593866399};
inline constexpr std::array<double, 5> weights = {0.23692688505618909, 0.47862867049936647, 0.56888888888888889,
                                                  0.47862867049936647, 0.23692688505618909};

/// Integral of f(x) over a spherocylinder along z about its centre: Gauss-Legendre along z (cap, cylinder, cap) and
/// along the radius, equal steps in the angle.
template <class T, class F>
T integrate(double length, double diameter, F&& f) {
    constexpr int angles = 8;
    const double radius = 0.5 * diameter;
    const std::array<double, 4> ends = {-0.5 * length - radius, -0.5 * length, 0.5 * length, 0.5 * length + radius};
    T sum{};
    for (std::size_t piece = 0; piece < 3; ++piece) {
        const double half = 0.5 * (ends[piece + 1] - ends[piece]);
        for (std::size_t a = 0; a < 5; ++a) {
            const double z = ends[piece] + half * (1.0 + nodes[a]);
            const double beyond = std::max(std::fabs(z) - 0.5 * length, 0.0);
            const double half_width = 0.5 * std::sqrt(radius * radius - beyond * beyond);
            for (std::size_t b = 0; b < 5; ++b) {
                const double rho = half_width * (1.0 + nodes[b]);
                const double weight =
                    half * weights[a] * half_width * weights[b] * rho * 2.0 * std::numbers::pi / angles;
                for (int c = 0; c < angles; ++c) {
                    const double angle = 2.0 * std::numbers::pi * (c + 0.3) / angles;
                    sum += weight * f(Vec3{rho * std::cos(angle), rho * std::sin(angle), z});
                }
            }
        }
    }
    return sum;
}

/// Integral of f(x) over a box about the origin, with f of up to the ninth degree along each edge.
template <class T, class F>
T integrate_box(const Vec3& edges, F&& f) {
    T sum{};
    for (std::size_t a = 0; a < 5; ++a)
        for (std::size_t b = 0; b < 5; ++b)
            for (std::size_t c = 0; c < 5; ++c) {
                const double weight = weights[a] * weights[b] * weights[c] * edges.x * edges.y * edges.z / 8.0;
                sum += weight * f(0.5 * Vec3{nodes[a] * edges.x, nodes[b] * edges.y, nodes[c] * edges.z});
            }
    return sum;
}

/// Integral of f(x) over what a mesh around the origin encloses: the rule of four points for each tetrahedron.
template <class T, class F>
T integrate_mesh(const Mesh& mesh, F&& f) {
    const double near = (5.0 + 3.0 * std::sqrt(5.0)) / 20.0, far = (5.0 - std::sqrt(5.0)) / 20.0;
    T sum{};
    for (const auto& [i, j, k] : mesh.triangles) {
        const Vec3 a = mesh.vertices[i], b = mesh.vertices[j], c = mesh.vertices[k];
        const double weight = dot(a, cross(b, c)) / 24.0;
        for (const Vec3& x :
             {far * (a + b + c), near * a + far * (b + c), near * b + far * (a + c), near * c + far * (a + b)})
            sum += weight * f(x);
    }
    return sum;
}

}  // namespace jostle::test
