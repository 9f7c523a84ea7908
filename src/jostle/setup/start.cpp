#include "jostle/setup/start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "jostle/contact/fixed_rod_search.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/rods/space_filling_order.hpp"
#include "jostle/rods/wall.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/setup/largest_overlap.hpp"
#include "jostle/setup/scattered_rods.hpp"

namespace jostle {

namespace {

/// Overlaps below this (in D) in a start read from a file are taken for rounding of the file's decimals.
constexpr double file_overlap = 1e-3;

Rods at_random(Rods rods, const Box& box, bool turning, const Scene& scene, const AnnealingWatch& watch) {
    OverlapRemovalResult result;
    result.overlap = largest_overlap(rods, box);
    if (result.overlap > 0.0 && turning)
        result = anneal(rods, box, scene.seed, watch);
    else
        result = remove_overlaps(rods, box, DragMobility(overlap_removal_drag(turning)));
    if (!result.apart) {
        throw InputError({.key = "rods.start",
                          .value = turning ? "\"random\"" : "\"aligned\"",
                          .problem = fmt::format("{} rods of length {} at {} {:.4f} could not be placed without "
                                                 "overlap: after {} rounds of pushing apart {:.3g} D are left",
                                                 rods.size(), scene.rods.length, fraction_words(scene),
                                                 total_volume(rods, box.dimensions()) / box.volume(), result.rounds,
                                                 result.overlap / scene.rods.diameter),
                          .suggestion = fmt::format("Use a lower {}, a roomier box, or start = {}\"lattice\"",
                                                    fraction_words(scene), turning ? "\"aligned\" or " : "")});
    }
    rods.image.assign(rods.size(), Image{0, 0, 0});
    return in_order_of_ids(rods);  // annealing has renumbered them
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

/// How the rods of a scene stand in rows.
struct Lattice {
    Vec3 axis;
    std::array<int, 3> direction{};  ///< of the box: along the rods, then across
    std::array<double, 3> edges{};   ///< of the box, in these directions
    std::array<std::uint64_t, 3> sites{};
};

/// Errors: InputError if they do not fit into the box so.
Lattice lattice_of(const Scene& scene, const Box& box) {
    const Vec3 axis = normalised(scene.rods.axis);
    const int along = std::fabs(axis.x) > 0.5 ? 0 : (std::fabs(axis.y) > 0.5 ? 1 : 2);
    if (std::fabs(axis[along]) < 1.0 - 1e-12)
        throw InputError({.key = "rods.axis",
                          .value = fmt::format("[{}, {}, {}]", axis.x, axis.y, axis.z),
                          .problem = "a lattice needs its rods along an edge of the box",
                          .allowed = "[1, 0, 0], [0, 1, 0] or [0, 0, 1]",
                          .suggestion = "For another direction use start = \"aligned\""});
    const bool flat = box.dimensions() == 2;
    Lattice lattice{axis, {along, flat ? 2 : (along + 1) % 3, flat ? 1 - along : (along + 2) % 3}, {}, {}};
    const double D = scene.rods.diameter;
    for (std::size_t k = 0; k < 3; ++k)
        lattice.edges[k] = lattice.direction[k] < box.dimensions() ? box.edges()[lattice.direction[k]] : INFINITY;
    const Grid grid = roomiest_grid(scene.rods.count, lattice.edges, {scene.rods.length + D, D, D});
    if (grid.tightness > 1.0)
        throw InputError(
            {.key = "rods.start",
             .value = "\"lattice\"",
             .problem = fmt::format("{} rods do not fit into the box in rows: the best grid, {} x {} x {}, would "
                                    "need edges {:.4g} times longer",
                                    scene.rods.count, grid.sites[0], grid.sites[1], grid.sites[2], grid.tightness),
             .suggestion = fmt::format("Use a lower {} or another box.shape", fraction_words(scene))});
    lattice.sites = grid.sites;
    return lattice;
}

Rods rods_in_rows(const Scene& scene, const Box& box) {
    const auto& [axis, direction, edges, in_row] = lattice_of(scene, box);
    Rods rods;
    const std::uint64_t sites = in_row[0] * in_row[1] * in_row[2];
    for (std::uint64_t id = 0; id < scene.rods.count; ++id) {
        // Vacant sites, if any, lie evenly among the others.
        const auto site = static_cast<std::uint64_t>(static_cast<double>(id) * static_cast<double>(sites) /
                                                     static_cast<double>(scene.rods.count));
        const std::array<std::uint64_t, 3> cell = {site / (in_row[2] * in_row[1]), site / in_row[2] % in_row[1],
                                                   site % in_row[2]};
        Vec3 centre;
        for (std::size_t k = 0; k < 3; ++k)
            if (std::isfinite(edges[k]))
                centre[direction[k]] = (static_cast<double>(cell[k]) + 0.5) * edges[k] / static_cast<double>(in_row[k]);
        rods.push_back(id, centre, axis, scene.rods.length, scene.rods.diameter);
    }
    return rods;
}

/// Where rods of a start come from, as messages say it.
struct Origin {
    const char* key;
    std::string name;
};

/// Refuses rods for which overlap_of(row) is above `allowed`; `does`: "reaches beyond a wall".
template <class OverlapOf>
void require_overlaps_below(double allowed, const Rods& rods, const Origin& origin, const char* does,
                            OverlapOf&& overlap_of) {
    for (std::size_t i = 0; i < rods.size(); ++i)
        if (const double overlap = overlap_of(i); overlap > allowed)
            throw InputError({.key = origin.key,
                              .value = "\"" + origin.name + "\"",
                              .problem = fmt::format("rod {} (row {}) {} by {:.3g}: its centre is ({:.6g}, {:.6g}, "
                                                     "{:.6g})",
                                                     rods.id[i], i + 1, does, overlap, rods.centre[i].x,
                                                     rods.centre[i].y, rods.centre[i].z),
                              .allowed = fmt::format("at most {:.3g}", allowed)});
}

/// Refuses rods that reach beyond a wall by more than `allowed`.
void require_inside(const Rods& rods, const Box& box, double allowed, const Origin& origin) {
    const std::vector<Wall> walls = walls_of(box);
    require_overlaps_below(allowed, rods, origin, "reaches beyond a wall",
                           [&](std::size_t row) { return overlap_with_walls(walls, box.walls(), rods, row); });
}

/// Refuses rods that reach into fixed rods by more than `allowed`.
void require_beside_fixed_rods(const Rods& rods, const Box& box, double allowed, const Origin& origin) {
    const FixedRodGrid fixed = grid_of_fixed_rods(box, rods);
    require_overlaps_below(allowed, rods, origin, "overlaps a fixed rod",
                           [&](std::size_t row) { return overlap_with_fixed_rods(fixed, rods, row); });
}

Rods checked(Rods rods, const Box& box, const Scene& scene) {
    for (std::size_t i = 0; i < rods.size(); ++i) box.wrap(rods.centre[i], rods.image[i]);
    rods.image.assign(rods.size(), Image{0, 0, 0});
    const bool of_run = scene.rods.start == StartKind::run;
    const double allowed = (of_run ? scene.contact.overlap_limit : file_overlap) * scene.rods.diameter;
    const Origin origin = of_run ? Origin{"rods.run", scene.rods.run} : Origin{"rods.file", scene.rods.file};
    require_inside(rods, box, allowed, origin);
    require_beside_fixed_rods(rods, box, allowed, origin);
    const double overlap = largest_overlap(rods, box);
    if (overlap > allowed)
        throw InputError(
            {.key = origin.key,
             .value = "\"" + origin.name + "\"",
             .problem = fmt::format("{} overlap by up to {:.3g}{}", of_run ? "its rods" : "rods of this file", overlap,
                                    of_run ? " in the box of this scene" : ""),
             .allowed = fmt::format("overlaps up to {:.3g}", allowed),
             .suggestion = of_run ? "Give the box of that run, or a roomier one" : ""});
    return rods;
}

}  // namespace

void require_lattice_fits(const Scene& scene, const Box& box) {
    if (scene.rods.start == StartKind::lattice) lattice_of(scene, box);
}

std::string start_warning(const Scene& scene, double volume_fraction) {
    const double aspect_ratio = scene.rods.length / scene.rods.diameter,
                 limit = isotropic_limit(aspect_ratio, dimensions_of(scene));
    if (scene.rods.start != StartKind::random || !keeps_equilibrium(scene) || volume_fraction <= limit) return "";
    return fmt::format(
        "a random start is isotropic, and beyond {} {} of about {:.2f} rods of L/D = {:.3g} "
        "order, which takes longer than most runs: start = \"aligned\" is nearer to equilibrium",
        dimensions_of(scene) == 2 ? "an" : "a", fraction_words(scene), limit, aspect_ratio);
}

Rods make_start(const Scene& scene, const Box& box, const std::optional<Rods>& from_file, const AnnealingWatch& watch) {
    parallel::suit_thread_count(parallel::worthwhile_thread_count(scene.rods.count));
    switch (scene.rods.start) {
        case StartKind::random:
            return at_random(scattered_rods(scene, box, std::nullopt), box, true, scene, watch);
        case StartKind::aligned:
            return at_random(scattered_rods(scene, box, normalised(scene.rods.axis)), box, false, scene, watch);
        case StartKind::lattice: {
            Rods rods = rods_in_rows(scene, box);
            require_beside_fixed_rods(rods, box, 0.0, {"rods.start", "lattice"});
            return rods;
        }
        case StartKind::file:
        case StartKind::run:
            return checked(from_file.value(), box, scene);
    }
    return {};
}

}  // namespace jostle
