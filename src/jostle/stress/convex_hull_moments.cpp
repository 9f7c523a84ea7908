#include <fmt/format.h>

extern "C" {
#include <libqhull_r/libqhull_r.h>
}

#include <array>
#include <vector>

#include "jostle/error/input_error.hpp"
#include "jostle/stress/mesh_moments.hpp"
#include "jostle/stress/tetrahedra.hpp"

namespace jostle {

namespace {

[[noreturn]] void refuse_points(std::string problem) {
    throw InputError({.key = "points",
                      .problem = std::move(problem),
                      .allowed = "at least 4 points that are not in a plane",
                      .suggestion = ""});
}

using Corners = std::array<Vec3, 3>;

/// Qhull's memory while it lives, and what Qhull would print.
class Hull {
public:
    /// The convex hull of (n x 3) coordinates, its faces cut into triangles ("Qt").
    explicit Hull(std::vector<double>& coordinates) {
        char command[] = "qhull Qt";
        qh_zero(qh_, messages_);
        status_ = qh_new_qhull(qh_, 3, static_cast<int>(coordinates.size() / 3), coordinates.data(), False, command,
                               nullptr, messages_);
    }
    Hull(const Hull&) = delete;
    Hull& operator=(const Hull&) = delete;
    ~Hull() {
        int blocks = 0, bytes = 0;
        qh_freeqhull(qh_, !qh_ALL);
        qh_memfreeshort(qh_, &blocks, &bytes);
        fclose(messages_);
        free(text_);
    }

    /// 0, or an error code of Qhull.
    int status() const { return status_; }

    /// The triangles, in no order and turned in any way.
    std::vector<Corners> faces(std::span<const Vec3> points) const {
        std::vector<Corners> faces;
        for (const facetT* facet = qh_->facet_list; facet != nullptr && facet->next != nullptr; facet = facet->next) {
            Corners& face = faces.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) {
                const auto* vertex = static_cast<const vertexT*>(facet->vertices->e[k].p);
                face[k] = points[static_cast<std::size_t>(qh_pointid(qh_, vertex->point))];
            }
        }
        return faces;
    }

private:
    char* text_ = nullptr;
    std::size_t size_ = 0;
    FILE* messages_ = open_memstream(&text_, &size_);
    qhT memory_{};
    qhT* qh_ = &memory_;
    int status_ = 0;
};

std::vector<Corners> hull_of(std::span<const Vec3> points) {
    std::vector<double> coordinates;
    for (const Vec3& point : points) coordinates.insert(coordinates.end(), {point.x, point.y, point.z});
    const Hull hull(coordinates);
    if (hull.status() != 0) refuse_points(fmt::format("have no convex hull (Qhull error {})", hull.status()));
    return hull.faces(points);
}

}  // namespace

BodyMoments convex_hull_moments(std::span<const Vec3> points) {
    const Vec3 middle = middle_of("points", points);
    if (points.size() < 4) refuse_points(fmt::format("are {}", points.size()));
    Tetrahedra sum(middle);
    double area = 0.0;
    // The middle is inside, so a face that faces it is turned the wrong way.
    for (const auto& [a, b, c] : hull_of(points)) {
        const Vec3 normal = cross(b - a, c - a);
        dot(normal, a - middle) > 0.0 ? sum.add(a, b, c) : sum.add(a, c, b);
        area += 0.5 * norm(normal);
    }
    if (!(sum.volume() > least_volume(area))) refuse_points("are in a plane");
    return sum.moments();
}

}  // namespace jostle
