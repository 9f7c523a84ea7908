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
#include "jostle/setup/lattice.hpp"
#include "jostle/setup/scattered_rods.hpp"

namespace jostle {

namespace {

/// Overlaps below this (in D) in a start read from a file are taken for rounding of the file's decimals.
constexpr double file_overlap = 1e-3;

Rods at_random(Rods rods, const Box& box, bool turning, const Scene& scene, const AnnealingWatch& watch,
               const Ranks& ranks) {
    OverlapRemovalResult result;
    result.overlap = largest_overlap(rods, box);
    if (result.overlap > 0.0 && turning)
        result = anneal(rods, box, scene.seed, watch, ranks);
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

bool places_are_drawn(const Scene& scene) {
    return scene.rods.start == StartKind::random || scene.rods.start == StartKind::aligned;
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

Rods make_start(const Scene& scene, const Box& box, const std::optional<Rods>& from_file, const AnnealingWatch& watch,
                const Ranks& ranks) {
    parallel::suit_thread_count(parallel::worthwhile_thread_count(scene.rods.count));
    switch (scene.rods.start) {
        case StartKind::random:
            return at_random(scattered_rods(scene, box, std::nullopt, ranks), box, true, scene, watch, ranks);
        case StartKind::aligned:
            return at_random(scattered_rods(scene, box, normalised(scene.rods.axis), ranks), box, false, scene, watch,
                             ranks);
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
