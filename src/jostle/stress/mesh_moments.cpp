#include "jostle/stress/mesh_moments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "jostle/error/input_error.hpp"
#include "jostle/stress/tetrahedra.hpp"

namespace jostle {

namespace {

[[noreturn]] void refuse_mesh(std::string key, std::string problem, std::string suggestion = "") {
    throw InputError({.key = std::move(key), .problem = std::move(problem), .suggestion = std::move(suggestion)});
}

void require_corners(std::span<const Triangle> triangles, std::size_t vertices) {
    for (std::size_t k = 0; k < triangles.size(); ++k) {
        const auto& [a, b, c] = triangles[k];
        const std::string key = fmt::format("triangles[{}] = {} {} {}", k, a, b, c);
        if (std::max({a, b, c}) >= vertices) refuse_mesh(key, fmt::format("there are {} vertices, from 0", vertices));
        if (a == b || b == c || c == a) refuse_mesh(key, "names a vertex twice");
    }
}

/// An edge of a triangle, its smaller vertex first, and whether the triangle runs along it the other way.
struct Edge {
    std::uint32_t from, to;
    bool reversed;
};

std::vector<Edge> sorted_edges(std::span<const Triangle> triangles) {
    std::vector<Edge> edges;
    edges.reserve(3 * triangles.size());
    for (const Triangle& triangle : triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = triangle[k], to = triangle[(k + 1) % 3];
            edges.push_back({std::min(from, to), std::max(from, to), to < from});
        }
    std::sort(edges.begin(), edges.end(),
              [](const Edge& a, const Edge& b) { return std::tie(a.from, a.to) < std::tie(b.from, b.to); });
    return edges;
}

/// Every edge must be run along as often one way as the other: only then do the tetrahedra add up to a volume.
void require_closed(std::span<const Triangle> triangles) {
    const std::vector<Edge> edges = sorted_edges(triangles);
    std::size_t open = 0, unlike = 0;
    Edge first{};
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        int balance = 0;
        for (; end < edges.size() && edges[end].from == edges[begin].from && edges[end].to == edges[begin].to; ++end)
            balance += edges[end].reversed ? -1 : 1;
        if (balance == 0) continue;
        if (open + unlike == 0) first = edges[begin];
        ++((end - begin) % 2 == 1 ? open : unlike);
    }
    const std::string where = fmt::format("the first is from vertex {} to {}", first.from, first.to);
    if (open > 0)
        refuse_mesh("triangles", fmt::format("the mesh is open: {} edges belong to one triangle only, {}", open, where),
                    "Close its holes, and merge vertices that stand at the same place");
    if (unlike > 0)
        refuse_mesh(
            "triangles",
            fmt::format("the triangles on the two sides of {} edges are turned in opposite ways, {}", unlike, where),
            "Order the corners of every triangle anticlockwise as seen from outside");
}

double area_of(std::span<const Vec3> vertices, std::span<const Triangle> triangles) {
    double area = 0.0;
    for (const auto& [a, b, c] : triangles)
        area += 0.5 * norm(cross(vertices[b] - vertices[a], vertices[c] - vertices[a]));
    return area;
}

}  // namespace

BodyMoments mesh_moments(std::span<const Vec3> vertices, std::span<const Triangle> triangles) {
    const Vec3 middle = middle_of("vertices", vertices);
    require_corners(triangles, vertices.size());
    require_closed(triangles);
    Tetrahedra sum(middle);
    for (const auto& [a, b, c] : triangles) sum.add(vertices[a], vertices[b], vertices[c]);
    const double area = area_of(vertices, triangles);
    const double smallest = least_volume(area);
    if (sum.volume() < -smallest)
        refuse_mesh("triangles", fmt::format("the mesh is inside out: its volume is {:.6g}", sum.volume()),
                    "Exchange two corners of every triangle, so that they are anticlockwise as seen from outside");
    if (!(sum.volume() > smallest))
        refuse_mesh("triangles",
                    fmt::format("the mesh encloses nothing: volume {:.3g}, area {:.6g}", sum.volume(), area));
    return sum.moments();
}

}  // namespace jostle
