#include "jostle/setup/lattice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "jostle/error/input_error.hpp"
#include "jostle/rods/wall.hpp"
#include "jostle/scene/scene_box.hpp"

namespace jostle {

namespace {

/// Of the box: along the rods (0), then across (1, 2).
struct Directions {
    Vec3 axis;
    std::array<int, 3> of_box{};
    std::array<double, 3> edges{};  ///< infinite where a flat box has none
    std::array<double, 3> size{};   ///< of a rod
};

/// Errors: InputError if the rods lie along no edge.
Directions directions_of(const Scene& scene, const Box& box) {
    const Vec3 axis = normalised(scene.rods.axis);
    const int along = std::fabs(axis.x) > 0.5 ? 0 : (std::fabs(axis.y) > 0.5 ? 1 : 2);
    if (std::fabs(axis[along]) < 1.0 - 1e-12)
        throw InputError({.key = "rods.axis",
                          .value = fmt::format("[{}, {}, {}]", axis.x, axis.y, axis.z),
                          .problem = "a lattice needs its rods along an edge of the box",
                          .allowed = "[1, 0, 0], [0, 1, 0] or [0, 0, 1]",
                          .suggestion = "For another direction use start = \"aligned\""});
    const bool flat = box.dimensions() == 2;
    const double D = scene.rods.diameter;
    Directions directions{axis,
                          {along, flat ? 2 : (along + 1) % 3, flat ? 1 - along : (along + 2) % 3},
                          {},
                          {scene.rods.length + D, D, D}};
    for (std::size_t k = 0; k < 3; ++k)
        directions.edges[k] = directions.of_box[k] < box.dimensions() ? box.edges()[directions.of_box[k]] : INFINITY;
    return directions;
}

/// Sites along the rods (direction 0) and across (1, 2).
struct Grid {
    std::array<std::uint64_t, 3> sites{};
    double tightness = INFINITY;  ///< the largest of size/spacing over the directions; 1 means touching
};

/// The grid with at least `count` sites that leaves the most room in its tightest direction; one site along an edge of
/// infinity, which stands for one that a flat box has not.
Grid roomiest_grid(std::uint64_t count, const std::array<double, 3>& edges, const std::array<double, 3>& size) {
    Grid best;
    const auto most = [&](std::size_t k) {
        if (std::isinf(edges[k])) return std::uint64_t{1};
        return static_cast<std::uint64_t>(std::clamp(edges[k] / size[k], 1.0, static_cast<double>(count)));
    };
    for (std::uint64_t across = 1; across <= most(1); ++across) {
        // More than one site for each rod would only be tighter.
        for (std::uint64_t along = 1; along <= most(0) && (along - 1) * across < count; ++along) {
            const std::uint64_t rest = (count + across * along - 1) / (across * along);
            Grid grid{{along, across, rest}, 0.0};
            for (std::size_t k = 0; k < 3; ++k)
                grid.tightness = std::max(grid.tightness, static_cast<double>(grid.sites[k]) * size[k] / edges[k]);
            if (grid.tightness < best.tightness) best = grid;
        }
    }
    return best;
}

[[noreturn]] void refuse_lattice(const Scene& scene, std::string problem) {
    throw InputError({.key = "rods.start",
                      .value = "\"lattice\"",
                      .problem = std::move(problem),
                      .suggestion = fmt::format("Use a lower {} or another box.shape", fraction_words(scene))});
}

/// `count` points of a line from 0 to `edge`, evenly spaced.
std::vector<double> evenly(std::uint64_t count, double edge) {
    std::vector<double> places;
    for (std::uint64_t k = 0; k < count; ++k)
        places.push_back((static_cast<double>(k) + 0.5) * edge / static_cast<double>(count));
    return places;
}

/// Sites of the grid of these places, along directions 0, 1 and 2, where rods reach beyond no wall.
std::vector<Vec3> sites_of(const std::array<std::vector<double>, 3>& places, const Directions& directions,
                           const Scene& scene, const Box& box) {
    const std::vector<Wall> walls = walls_of(box);
    const double rounding = 1e-9 * scene.rods.diameter;
    std::vector<Vec3> sites;
    Vec3 site;
    for (const double along : places[0])
        for (const double first : places[1])
            for (const double second : places[2]) {
                site[directions.of_box[0]] = along;
                site[directions.of_box[1]] = first;
                site[directions.of_box[2]] = second;
                if (overlap_with_walls(walls, box.walls(), site, directions.axis, scene.rods.length,
                                       scene.rods.diameter) <= rounding)
                    sites.push_back(site);
            }
    return sites;
}

/// The grid of a box without container. Errors: InputError if the rods do not fit.
Grid grid_between_faces(const Scene& scene, const Directions& directions) {
    const Grid grid = roomiest_grid(scene.rods.count, directions.edges, directions.size);
    if (grid.tightness > 1.0)
        refuse_lattice(scene,
                       fmt::format("{} rods do not fit into the box in rows: the best grid, {} x {} x {}, would "
                                   "need edges {:.4g} times longer",
                                   scene.rods.count, grid.sites[0], grid.sites[1], grid.sites[2], grid.tightness));
    return grid;
}

/// Its sites: evenly spaced from face to face.
std::vector<Vec3> sites_between_faces(const Scene& scene, const Box& box, const Directions& directions) {
    const Grid grid = grid_between_faces(scene, directions);
    std::array<std::vector<double>, 3> places;
    for (std::size_t k = 0; k < 3; ++k)
        places[k] = std::isinf(directions.edges[k]) ? std::vector{0.0} : evenly(grid.sites[k], directions.edges[k]);
    return sites_of(places, directions, scene, box);
}

/// Places from the middle of a container outwards, `spacing` apart; one of them in the middle, or none.
std::vector<double> about_the_middle(double spacing, double edge, bool one_in_the_middle) {
    std::vector<double> places;
    const auto most = static_cast<std::int64_t>(0.5 * edge / spacing);
    for (std::int64_t k = -most - 1; k <= most; ++k) {
        const double from_middle = (static_cast<double>(k) + (one_in_the_middle ? 0.0 : 0.5)) * spacing;
        if (std::fabs(from_middle) < 0.5 * edge) places.push_back(0.5 * edge + from_middle);
    }
    return places;
}

/// The most sites of a grid within a container, of eight: one of its lines along each direction goes through the
/// middle, or passes it half way between two. Rods are `wider` times as far apart as they have to be, at least.
std::vector<Vec3> most_sites_within(const Scene& scene, const Box& box, const Directions& directions, double wider) {
    std::vector<Vec3> most;
    for (unsigned middle = 0; middle < 8; ++middle) {
        std::array<std::vector<double>, 3> places;
        for (std::size_t k = 0; k < 3; ++k) {
            const double edge = directions.edges[k], spacing = wider * directions.size[k];
            const bool along_tube =
                box.walls().container == Container::tube && directions.of_box[k] == box.walls().axis;
            if (std::isinf(edge))
                places[k] = {0.0};
            else if (along_tube)
                places[k] = evenly(
                    std::max<std::uint64_t>(1, static_cast<std::uint64_t>(edge / spacing * (1.0 + 1e-12))), edge);
            else
                places[k] = about_the_middle(spacing, edge, (middle >> k & 1u) == 0);
        }
        std::vector<Vec3> sites = sites_of(places, directions, scene, box);
        if (sites.size() > most.size()) most = std::move(sites);
    }
    return most;
}

/// The same with as much room between the rods as so many sites leave, to one per cent.
std::vector<Vec3> sites_within_container(const Scene& scene, const Box& box, const Directions& directions) {
    double per_site = 1.0;
    for (std::size_t k = 0; k < 3; ++k)
        if (std::isfinite(directions.edges[k])) per_site *= directions.size[k];
    const double widest = std::cbrt(box.volume() / (static_cast<double>(scene.rods.count) * per_site));
    for (double wider = box.dimensions() == 2 ? std::pow(widest, 1.5) : widest; wider > 1.0; wider *= 0.99) {
        std::vector<Vec3> sites = most_sites_within(scene, box, directions, wider);
        if (sites.size() >= scene.rods.count) return sites;
    }
    std::vector<Vec3> sites = most_sites_within(scene, box, directions, 1.0);
    if (sites.size() < scene.rods.count)
        refuse_lattice(scene, fmt::format("{} rods do not fit into the container in rows: of touching rods it holds {}",
                                          scene.rods.count, sites.size()));
    return sites;
}

std::vector<Vec3> lattice_sites(const Scene& scene, const Box& box, const Directions& directions) {
    return box.walls().container == Container::none ? sites_between_faces(scene, box, directions)
                                                    : sites_within_container(scene, box, directions);
}

}  // namespace

Rods rods_in_rows(const Scene& scene, const Box& box) {
    const Directions directions = directions_of(scene, box);
    const std::vector<Vec3> sites = lattice_sites(scene, box, directions);
    Rods rods;
    for (std::uint64_t id = 0; id < scene.rods.count; ++id) {
        // Vacant sites, if any, lie evenly among the others.
        const auto site = static_cast<std::size_t>(static_cast<double>(id) * static_cast<double>(sites.size()) /
                                                   static_cast<double>(scene.rods.count));
        rods.push_back(id, sites[site], directions.axis, scene.rods.length, scene.rods.diameter);
    }
    return rods;
}

void require_lattice_fits(const Scene& scene, const Box& box) {
    if (scene.rods.start != StartKind::lattice) return;
    const Directions directions = directions_of(scene, box);
    if (box.walls().container == Container::none)
        grid_between_faces(scene, directions);
    else
        sites_within_container(scene, box, directions);
}

}  // namespace jostle
